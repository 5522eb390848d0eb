--- Spikes: short hair that stands in locks.
--
--     lissom run scripts/presets/spiky.lua --length 0.05 --spikes 400
local lissom = require "lissom"
local styling = require "styling"

return styling.preset(..., {
    name = "spiky",
    edge = "short",
    schema = {
        length = { type = "number", default = 0.06, min = 0.02, max = 0.09, unit = "metres",
            help = "on top" },
        spikes = { type = "integer", default = 260, min = 40, max = 2000, help = "number of spikes" },
        sharp = { type = "number", default = 0.93, min = 0, max = 1, help = "how closely a spike gathers" },
        disorder = { type = "number", default = 0.012, min = 0, max = 0.04, unit = "metres",
            help = "how far spikes lean" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local style = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = o.resolution,
            volume = { min = { -0.18, -0.2, -0.2 }, max = { 0.18, 0.24, 0.2 } } })
        styling.radial(style, 80, 14)
        local lengths = styling.by_angles(scalp, function(_, elevation)
            return v.length * (0.37 + 0.63 * styling.smooth(-10, 55, elevation))
        end)
        local hair = style:grow{ count = o.count, seed = v.seed, length = lengths, layer = 0,
            clearance = 0.001,
            lift = 0.3, variation = 0.22 }
        hair:resample{ count = 14 }
        hair:noise{ amplitude = v.disorder, across = 0.03, along = 0.08, seed = 2 + v.seed }
        hair:clump{ clumps = v.spikes, strength = v.sharp, variation = 0.15, shape = 0.9,
            tip_spread = 0.0012, offset = 0.006, mask = styling.less_below(scalp, 0.3, -20, 35) }
        hair:push_out{ head = style }
        return style, styling.finish(hair, 0.00028, 0.001),
            { color = "#b88a4a", scalp_tint = 0.85, unit = scalp:unit() }
    end,
})
