--- A topknot: hair is pulled up to the crown and wound to a small knot.
--
--     lissom run scripts/presets/topknot.lua --radius 0.018 --tightness 0.6
local hairdo = require "hairdo"
local ponytails = require "ponytails"
local styling = require "styling"

return styling.preset(..., {
    name = "topknot",
    schema = {
        height = { type = "number", default = 50, min = 38, max = 50, unit = "degrees",
            help = "elevation of the tie" },
        radius = { type = "number", default = 0.0135, min = 0.008, max = 0.025, unit = "metres",
            help = "of the knot, to the middle of its ring" },
        lift = { type = "number", default = 0.012, min = 0, max = 0.03, unit = "metres",
            help = "of the knot above its tie" },
        tightness = { type = "number", default = 0.8, min = 0, max = 1,
            help = "how closely hair lies to the head" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local style, hair, tie = ponytails.grow(head,
            { height = v.height, tightness = v.tightness, length = 0.05, lift = 0.018, seed = v.seed },
            { scalp = scalp, resolution = o.resolution }, { count = o.count })
        ponytails.wind(hair, scalp, tie, v.radius, { tube = 1.15 * v.radius, lift = v.lift, turn = 280,
            locks = 5, loose = 0.03, seed = v.seed })
        hair:frizz{ amplitude = 0.001, wavelength = 0.03, flyaways = 0.03, flyaway = 5 }
        styling.finish(hair, 0.00024, 0.0008):push_out{ head = style, clearance = 0.001 }
        return style, hair, { color = "#5a3a22", unit = scalp:unit() }, { hairdo.ring(scalp, tie) }
    end,
})
