--- Pigtails: a tail at each side of the head, with a parting between them.
--
--     lissom run scripts/presets/pigtails.lua --height 30 --length 0.2
local hairdo = require "hairdo"
local styling = require "styling"
local tails = require "tails"

return styling.preset(..., {
    name = "pigtails",
    edge = "tied",
    schema = {
        height = { type = "number", default = 24, min = -10, max = 45, unit = "degrees",
            help = "elevation of the ties" },
        length = { type = "number", default = 0.2, min = 0.06, max = 0.34, unit = "metres",
            help = "of a tail" },
        fullness = { type = "number", default = 1.2, min = 0, max = 2, help = "how much the tails swell" },
        wave = { type = "number", default = 0.004, min = 0, max = 0.012, unit = "metres",
            help = "radius of the waves of the tails" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local style, ties = tails.both_sides(head, o, { azimuth = 112, elevation = v.height, lift = 0.02,
            radius = 0.016, droop = 0.05, length = 1.1 * v.length + 0.03, fullness = v.fullness,
            tail_length = v.length })
        local hair = style:grow{ count = o.count, seed = v.seed, length = 0.25 + v.length, layer = 0.007,
            clearance = 0.002 }
        hairdo.cull_missed(hair, scalp):resample{ step = 0.006 }:smooth{ iterations = 3 }
        hair:guides{ count = 400 }
        if v.wave > 0 then
            hair:wave{ radius = v.wave, wavelength = 0.07, start = 0.16, ramp = 0.1, keep_length = false,
                seed = v.seed }
        end
        styling.tail_ends(hair, v.seed)
        local rings = {}
        for i, tie in ipairs(ties) do rings[i] = hairdo.ring(scalp, tie) end
        styling.finish(hair, 0.00024, 0.001):push_out{ head = style, clearance = 0.001 }
        return style, hair, { color = "#b08850", unit = scalp:unit() }, rings
    end,
})
