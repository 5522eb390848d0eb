--- A high ponytail: hair is pulled up tightly to the crown and falls in a full tail.
--
--     lissom run scripts/presets/high_ponytail.lua --length 0.35 --wave 0.008
local hairdo = require "hairdo"
local ponytails = require "ponytails"
local styling = require "styling"

return styling.preset(..., {
    name = "high_ponytail",
    schema = {
        height = { type = "number", default = 50, min = 32, max = 50, unit = "degrees",
            help = "elevation of the tie" },
        length = { type = "number", default = 0.34, min = 0.1, max = 0.5, unit = "metres",
            help = "of the tail" },
        fullness = { type = "number", default = 1.4, min = 0, max = 2, help = "how much the tail swells" },
        tightness = { type = "number", default = 0.85, min = 0, max = 1,
            help = "how closely hair lies to the head" },
        wave = { type = "number", default = 0.003, min = 0, max = 0.012, unit = "metres",
            help = "radius of the waves of the tail" },
    },
    make = function(head, v, o)
        local style, hair, tie = ponytails.grow(head,
            { height = v.height, tightness = v.tightness, length = v.length, fullness = v.fullness,
                lift = 0.024, seed = v.seed },
            { scalp = o.scalp, resolution = o.resolution }, { count = o.count })
        hairdo.cull_missed(hair, o.scalp):resample{ step = 0.006 }:smooth{ iterations = 3 }
        hair:guides{ count = 500 }
        if v.wave > 0 then
            hair:wave{ radius = v.wave, wavelength = 0.09, start = 0.2, ramp = 0.1, keep_length = false,
                seed = v.seed }
        end
        styling.tail_ends(hair, v.seed, "ponytail")
        styling.finish(hair, 0.00024, 0.001):push_out{ head = style, clearance = 0.001 }
        return style, hair, { color = "#3c2415", primary = 0.17, unit = o.scalp:unit() },
            { hairdo.ring(o.scalp, tie) }
    end,
})
