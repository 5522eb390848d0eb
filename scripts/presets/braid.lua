--- A braid behind the head: hair is gathered at a low tie and braided down the back.
--
--     lissom run scripts/presets/braid.lua --length 0.3 --radius 0.011
local hairdo = require "hairdo"
local ponytail = require "presets.ponytail"
local styling = require "styling"

-- The way down of a braid from its tie, in metres: `away` from the head, as far as that reaches.
local function way_down(scalp, tie, length, away)
    local frame = { azimuth = tie.azimuth, elevation = tie.elevation, lift = tie.lift }
    local at, normal = scalp:at(frame), scalp:normal_at(frame)
    local p, tip = scalp:to_metres(at), {}
    for k = 1, 3 do tip[k] = at[k] + normal[k] * scalp:scale() end
    local to, d, points = scalp:to_metres(tip), {}, { at }
    for k = 1, 3 do d[k] = to[k] - p[k] end
    for i = 1, math.ceil(length / 0.004) do
        local q = scalp:to_metres(scalp:head():nearest(scalp:from_metres(p)).position)
        local off = { p[1] - q[1], p[2] - q[2], p[3] - q[3] }
        local far = math.max(1e-6, math.sqrt(off[1] ^ 2 + off[2] ^ 2 + off[3] ^ 2))
        local push = far > 0.05 and 0 or math.min(math.max((away - far) / 0.012, -0.6), 0.6)
        local v, size = {}, 0
        for k = 1, 3 do
            d[k] = d[k] + 0.22 * ((k == 2 and -1 or 0) - d[k])
            v[k] = d[k] + push * off[k] / far
            size = size + v[k] ^ 2
        end
        for k = 1, 3 do p[k] = p[k] + 0.004 * v[k] / math.sqrt(size) end
        if i % 2 == 0 then points[#points + 1] = scalp:from_metres(p) end
    end
    return points
end

return styling.preset(..., {
    name = "braid",
    schema = {
        height = { type = "number", default = -6, min = -12, max = 30, unit = "degrees",
            help = "elevation of the tie" },
        length = { type = "number", default = 0.25, min = 0.08, max = 0.5, unit = "metres",
            help = "of the braid" },
        radius = { type = "number", default = 0.0125, min = 0.006, max = 0.02, unit = "metres",
            help = "of each of its three strands" },
        tightness = { type = "number", default = 0.75, min = 0, max = 1,
            help = "how closely hair lies to the head" },
        tuft = { type = "number", default = 0.04, min = 0, max = 0.12, unit = "metres",
            help = "below the braid" },
    },
    make = function(head, v, o)
        local style, hair, tie = ponytail.grow(head,
            { height = v.height, tightness = v.tightness, length = 0.1, lift = 0.016, seed = v.seed },
            { scalp = o.scalp, resolution = o.resolution }, { count = o.count })
        local spine = way_down(o.scalp, tie, v.length + v.tuft + 0.05, 1.6 * v.radius)
        hair:smooth{ iterations = 3 }
        hair:braid{ spine = spine, scalp = o.scalp, across = o.scalp:left(), radius = v.radius,
            reach = 2.2 * tie.radius, length = v.length, tuft = v.tuft, seed = v.seed }
        hair:frizz{ amplitude = 0.0009, wavelength = 0.03 }
        styling.finish(hair, 0.00024, 0.0008):push_out{ head = style, clearance = 0.001 }
        return style, hair, { unit = o.scalp:unit() }, { hairdo.ring(o.scalp, tie) }
    end,
})
