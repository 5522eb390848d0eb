--- Grows a ponytail on a head.
local lissom = require "lissom"

local p = lissom.params{
    head = { type = "head", default = "", help = "a bald head; empty: a generated one" },
    count = { type = "integer", default = 2000, min = 10, max = 200000, help = "strands" },
    height = { type = "number", default = 25, min = -10, max = 50, unit = "degrees",
        help = "elevation of the tie" },
    length = { type = "number", default = 0.25, min = 0.05, max = 0.6, unit = "metres",
        help = "of the tail" },
}
local head = p.head == "" and lissom.shapes.head{ vertices = 12000 } or lissom.load(p.head)
local style = lissom.hairstyle(head, { resolution = 30000 })

-- Streams lead to the tie from both sides and over the crown.
local tie = style:at{ azimuth = 180, elevation = p.height, lift = 0.02 }
for _, one in ipairs{ { 0, 30, 0, 80 }, { 45, 30, 100, 60 }, { -45, 30, -100, 60 }, { 80, 0, 120, 20 },
    { -80, 0, -120, 20 }, { 150, -35, 165, -10 }, { -150, -35, -165, -10 } } do
    style:add_stream{ style:at{ azimuth = one[1], elevation = one[2], lift = 0.004 },
        style:at{ azimuth = one[3], elevation = one[4], lift = 0.01 }, tie }
end
-- The spine leaves the head at the tie, backwards, and falls.
local function way(from, to)
    local a, b = style:at(from), style:at(to)
    local d = { b[1] - a[1], b[2] - a[2], b[3] - a[3] }
    local length = math.sqrt(d[1] * d[1] + d[2] * d[2] + d[3] * d[3])
    return { d[1] / length, d[2] / length, d[3] / length }
end
local back = way({ azimuth = 0, elevation = 0 }, { azimuth = 180, elevation = 0 })
local down = way({ azimuth = 180, elevation = 60 }, { azimuth = 180, elevation = -20 })
local spine = {}
for i = 0, 12 do
    local t, point = i / 12, {}
    for k = 1, 3 do
        point[k] = tie[k] + p.length * ((0.5 * t - 0.25 * t * t) * back[k] + 0.9 * t * t * down[k])
    end
    spine[i + 1] = point
end
style:add_ponytail{ spine = spine, radius = 0.018, tail_length = p.length }
local hair = style:grow{ count = p.count, length = 0.2 + p.length, seed = 1 }
return style, hair
