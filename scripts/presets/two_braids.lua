--- Two braids from ties behind the ears over the shoulders, with a parting down to the nape.
--
--     lissom run scripts/presets/two_braids.lua --length 0.2 --radius 0.008
local hairdo = require "hairdo"
local styling = require "styling"
local tails = require "tails"

return styling.preset(..., {
    name = "two_braids",
    edge = "tied",
    schema = {
        height = { type = "number", default = -8, min = -14, max = 12, unit = "degrees",
            help = "elevation of the ties" },
        length = { type = "number", default = 0.24, min = 0.08, max = 0.36, unit = "metres",
            help = "of a braid" },
        radius = { type = "number", default = 0.0095, min = 0.005, max = 0.014, unit = "metres",
            help = "of each of its three strands" },
        tuft = { type = "number", default = 0.035, min = 0, max = 0.1, unit = "metres",
            help = "below a braid" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local style, ties = tails.both_sides(head, o, { azimuth = 132, elevation = v.height, lift = 0.013,
            radius = 0.017, droop = 0.03, length = 0.12, tail_length = 0.04 })
        local hair = style:grow{ count = o.count, seed = v.seed, length = 0.4, layer = 0.007,
            clearance = 0.002 }
        hair:smooth{ iterations = 3 }
        local rings = {}
        for i, tie in ipairs(ties) do
            local spine = tails.way_over_shoulder(scalp, tie, 0.02)
            hair:braid{ spine = spine, scalp = scalp,
                across = scalp:left(), radius = v.radius, reach = 2.2 * tie.radius, length = v.length,
                tuft = v.tuft, seed = v.seed }
            rings[i + 2] = tails.end_ring(scalp, spine, v.length, 0.5 * v.radius)
            rings[i] = hairdo.ring(scalp, { azimuth = tie.azimuth, elevation = tie.elevation,
                lift = tie.lift, radius = 0.9 * tie.radius })
        end
        hair:frizz{ amplitude = 0.0003, wavelength = 0.02, flyaways = 0.03, flyaway = 5 }
        styling.finish(hair, 0.00022, 0.0003):push_out{ head = style, clearance = 0.001 }
        return style, hair, { color = "#8a5a2c", unit = scalp:unit() }, rings
    end,
})
