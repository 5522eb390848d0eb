--- Loose waves: long hair from a side parting over the shoulders.
--
--     lissom run scripts/presets/waves.lua --length 0.28 --radius 0.012
local styling = require "styling"

local parting = { { -22, 37 }, { -28, 52 }, { -42, 68 }, { -70, 76 } }

return styling.preset(..., {
    name = "waves",
    edge = "loose",
    schema = {
        length = { type = "number", default = 0.235, min = 0.08, max = 0.33, unit = "metres",
            help = "of the ends below the middle of the head" },
        radius = { type = "number", default = 0.0115, min = 0, max = 0.02, unit = "metres",
            help = "of a wave" },
        wavelength = { type = "number", default = 0.095, min = 0.03, max = 0.2, unit = "metres",
            help = "of a wave" },
        locks = { type = "integer", default = 150, min = 20, max = 600, help = "number of locks" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local style = styling.long(head, o, styling.over_shoulders, parting)
        local hair = style:grow{ count = o.count, seed = v.seed, length = 0.225 + v.length, layer = 0.012,
            clearance = 0.004 }
        styling.wavy(hair, scalp, v.length, { locks = v.locks, factor = 0.65, ragged = 0.007,
            wave = { radius = v.radius, wavelength = v.wavelength, depth = 0.4, tip = 0.9, seed = v.seed } })
        styling.finish(hair, 0.00026, 0.0006):push_out{ head = style, clearance = 0.003 }
        return style, hair, { unit = scalp:unit() }
    end,
})
