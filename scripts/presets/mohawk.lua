--- A mohawk: a fin of standing hair between shaved sides.
--
--     lissom run scripts/presets/mohawk.lua --height 0.11 --width 0.03
local lissom = require "lissom"
local styling = require "styling"

return styling.preset(..., {
    name = "mohawk",
    edge = "short",
    schema = {
        height = { type = "number", default = 0.085, min = 0.02, max = 0.12, unit = "metres",
            help = "of the fin" },
        width = { type = "number", default = 0.044, min = 0.015, max = 0.08, unit = "metres",
            help = "of the fin" },
        sides = { type = "number", default = 0.004, min = 0.001, max = 0.02, unit = "metres",
            help = "length of the hair beside it" },
        spikes = { type = "integer", default = 90, min = 10, max = 600, help = "locks of the fin" },
    },
    make = function(head, v, o)
        local scalp, half = o.scalp, v.width / 2
        local beside = styling.by_angles(scalp, function(azimuth, elevation, p)
            return styling.smooth(half - 0.003, half, math.abs(p[1]))
                * styling.fade(azimuth, elevation, 0.5)
        end)
        local _, hair = styling.stubble(head, o, { part = 0.6, seed = v.seed, length = v.sides,
            density = beside })
        hair:set_colors{ color = { 0.04, 0.028, 0.02 } }
        local style = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = o.resolution,
            volume = { min = { -0.12, -0.2, -0.24 }, max = { 0.12, 0.28, 0.22 } } })
        styling.fin(style, v.width)
        local lengths = styling.by_angles(scalp, function(azimuth, elevation)
            local low = math.abs(azimuth) > 90 and 1 - styling.smooth(-40, 70, elevation) or 0
            return v.height * (1 - 0.78 * low)
        end)
        local inside = styling.by_angles(scalp, function(_, _, p)
            return 1 - styling.smooth(half, half + 0.003, math.abs(p[1]))
        end)
        local top = style:grow{ count = math.floor(0.9 * o.count), seed = v.seed, length = lengths, layer = 0,
            clearance = 0.001, lift = 0.5, variation = 0.08, density = inside }
        top:resample{ count = 16 }
        top:clump{ clumps = v.spikes, strength = 0.75, shape = 1.3, tip_spread = 0.003,
            mask = styling.less_below(scalp, 0.15, -20, 40) }
        top:clump{ clumps = 600, strength = 0.3 }:push_out{ head = style }
        styling.finish(top, 0.00026, 0.0015, o.count):set_colors{ color = { 0.30, 0.03, 0.05 } }
        return style, hair:append(top), { unit = scalp:unit() }
    end,
})
