--- A braid behind the head: hair is gathered at a low tie and braided down the back.
--
--     lissom run scripts/presets/braid.lua --length 0.3 --radius 0.011
local hairdo = require "hairdo"
local ponytails = require "ponytails"
local styling = require "styling"
local tails = require "tails"

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
        local style, hair, tie = ponytails.grow(head,
            { height = v.height, tightness = v.tightness, length = 0.1, lift = 0.016, seed = v.seed },
            { scalp = o.scalp, resolution = o.resolution }, { count = o.count })
        local spine = tails.way_down(o.scalp, tie, v.length + v.tuft + 0.05, 1.9 * v.radius)
        hair:smooth{ iterations = 3 }
        hair:braid{ spine = spine, scalp = o.scalp, across = o.scalp:left(), radius = v.radius,
            reach = 2.2 * tie.radius, length = v.length, tuft = v.tuft, seed = v.seed }
        hair:frizz{ amplitude = 0.0003, wavelength = 0.02, flyaways = 0.03, flyaway = 5 }
        styling.finish(hair, 0.00022, 0.0003):push_out{ head = style, clearance = 0.001 }
        return style, hair, { unit = o.scalp:unit() }, {
            hairdo.ring(o.scalp, tie), tails.end_ring(o.scalp, spine, v.length, 0.5 * v.radius) }
    end,
})
