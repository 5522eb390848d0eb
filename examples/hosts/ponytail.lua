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

-- The spine leaves the head at the tie and falls.
local spine = {}
for i = 0, 12 do
    local t = i / 12
    spine[i + 1] = style:at{ azimuth = 180, elevation = p.height - 1.2 * 100 * p.length * t * t,
        lift = 0.02 + 0.05 * math.sin(2.2 * t) }
end
style:add_ponytail{ spine = spine, radius = 0.018, tail_length = p.length }
local hair = style:grow{ count = p.count, length = 0.15 + p.length, seed = 1 }
return style, hair
