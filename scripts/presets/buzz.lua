--- A buzz cut: hair of a few millimetres all over the head.
--
--     lissom run scripts/presets/buzz.lua --length 0.009
local styling = require "styling"

return styling.preset(..., {
    name = "buzz",
    edge = "short",
    schema = {
        length = { type = "number", default = 0.006, min = 0.001, max = 0.025, unit = "metres",
            help = "of the hair" },
        fade = { type = "number", default = 0.55, min = 0, max = 1,
            help = "part by which hair is shorter and thinner at the hairline than on top" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local lengths = styling.by_angles(scalp, function(_, elevation)
            return v.length * (1 - v.fade * (1 - styling.smooth(-30, 40, elevation)))
        end)
        local density = styling.by_angles(scalp, function(azimuth, elevation)
            return styling.fade(azimuth, elevation, 0.9 * v.fade)
        end)
        local style, hair = styling.stubble(head, o, { length = lengths, density = density, seed = v.seed })
        styling.thin_out(hair:noise{ amplitude = 0.0008, across = 0.02, along = 0.11 })
        return style, hair, { color = "#33241a", primary = 0.05, scalp_tint = 0.8, unit = scalp:unit() }
    end,
})
