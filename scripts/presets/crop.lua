--- A crop: short hair that is longer on top, with a short fringe.
--
--     lissom run scripts/presets/crop.lua --top 0.045 --sides 0.008
local lissom = require "lissom"
local styling = require "styling"

return styling.preset(..., {
    name = "crop",
    edge = "short",
    schema = {
        top = { type = "number", default = 0.036, min = 0.012, max = 0.06, unit = "metres",
            help = "length of the hair on top" },
        sides = { type = "number", default = 0.006, min = 0.002, max = 0.03, unit = "metres",
            help = "length of the hair at nape and sideburns" },
        texture = { type = "number", default = 0.6, min = 0, max = 1,
            help = "how far hair gathers in locks" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local style = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = o.resolution })
        styling.streams(style, styling.crown_to_hairline)
        local lengths = styling.by_angles(scalp, function(azimuth, elevation)
            -- The top comes lower in front than at the sides and behind, in no step.
            local beside = styling.smooth(25, 75, math.abs(azimuth))
            local on_top = styling.smooth(26 + 6 * beside, 40 + 26 * beside, elevation)
            local side = v.sides + 0.2 * (v.top - v.sides) * styling.smooth(-10, 40, elevation)
            return side + (v.top - side) * on_top
        end)
        local hair = style:grow{ count = o.count, seed = v.seed, length = lengths, layer = 0.006,
            clearance = 0.0012, lift = 0.5, ramp = 0.02, variation = 0.3, segment = 0.25, min_speed = 0.01 }
        hair:resample{ count = 10 }
        hair:clump{ clumps = 700, strength = v.texture, tip_spread = 0.0015, offset = 0.0015, seed = v.seed }
        styling.finish(hair, 0.00026, 0.0012):push_out{ head = style, clearance = 0.0008 }
        return style, hair, { color = "#4a3020", scalp_tint = 0.8, unit = scalp:unit() }
    end,
})
