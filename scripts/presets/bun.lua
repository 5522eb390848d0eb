--- A bun: hair is gathered at a tie and wound around it.
--
--     lissom run scripts/presets/bun.lua --height 45 --radius 0.022
local ponytails = require "ponytails"
local styling = require "styling"

return styling.preset(..., {
    name = "bun",
    schema = {
        height = { type = "number", default = 22, min = -12, max = 50, unit = "degrees",
            help = "elevation of the tie" },
        radius = { type = "number", default = 0.0175, min = 0.01, max = 0.035, unit = "metres",
            help = "of the bun, to the middle of its ring" },
        tightness = { type = "number", default = 0.8, min = 0, max = 1,
            help = "how closely hair lies to the head" },
        turn = { type = "number", default = 165, min = 30, max = 360, unit = "degrees",
            help = "of hair around the bun" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local style, hair, tie = ponytails.grow(head,
            { height = v.height, tightness = v.tightness, length = 0.05, lift = 0.016, seed = v.seed },
            { scalp = scalp, resolution = o.resolution }, { count = o.count })
        ponytails.wind(hair, scalp, tie, v.radius, { tube = 1.11 * v.radius, turn = v.turn, seed = v.seed })
        hair:frizz{ amplitude = 0.0008, wavelength = 0.03, flyaways = 0.02, flyaway = 5 }
        styling.finish(hair, 0.00024, 0.0008):push_out{ head = style, clearance = 0.001 }
        return style, hair, { unit = scalp:unit() }
    end,
})
