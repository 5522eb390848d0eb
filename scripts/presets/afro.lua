--- An afro: tight coils that stand off the head, cut to a ball.
--
--     lissom run scripts/presets/afro.lua --height 0.12
local lissom = require "lissom"
local styling = require "styling"

-- Hair above the ears sinks over them, so that no notch parts the front from the back.
local function over_ears(length)
    local routes = {}
    for i, p in ipairs{ { 74, 8 }, { 92, 16 }, { 106, 16 }, { 120, 4 } } do
        routes[i] = { { p[1], p[2], 2 }, { p[1] + 2, p[2] - 9, length / 2 },
            { p[1] + 4, p[2] - 20, length } }
    end
    return routes
end

return styling.preset(..., {
    name = "afro",
    edge = "short",
    schema = {
        height = { type = "number", default = 0.1, min = 0.02, max = 0.14, unit = "metres",
            help = "of the hair above the scalp" },
        coil = { type = "number", default = 0.0018, min = 0.0005, max = 0.006, unit = "metres",
            help = "radius of a coil" },
        frizz = { type = "number", default = 0.0025, min = 0, max = 0.01, unit = "metres",
            help = "how far single hairs leave their coil" },
        ragged = { type = "number", default = 0.004, min = 0, max = 0.03, unit = "metres",
            help = "of the outline" },
    },
    make = function(head, v, o)
        local scalp, h = o.scalp, v.height
        local style = lissom.hairstyle(head, { scalp = scalp,
            gravity = 0, resolution = math.floor(0.8 * o.resolution),
            volume = { min = { -0.1 - h, -0.2, -0.12 - h }, max = { 0.1 + h, 0.14 + h, 0.1 + h } } })
        styling.radial(style, 1000 * h)
        styling.streams(style, over_ears(1000 * h))
        -- Over the ears the ball rounds off; hair of one length would end there in a ledge.
        local lengths = styling.by_angles(scalp, function(azimuth, elevation)
            local a = math.abs(azimuth)
            local beside = styling.smooth(50, 75, a) * (1 - styling.smooth(115, 135, a))
            return h * (1 - 0.45 * beside * (1 - styling.smooth(2, 34, elevation)))
        end)
        local hair = style:grow{ count = o.count, seed = v.seed, length = lengths,
            clearance = 0.001, layer = 0, variation = 0.1 }
        hair:resample{ step = 0.006 }:guides{ count = 6000 }
        hair:curl{ radius = v.coil, wavelength = 4 * v.coil, ramp = 0.008, start = 0, hang = 0, phase = 0.5,
            variation = 0.35, points_per_turn = 9, keep_length = false, seed = v.seed }
        hair:frizz{ amplitude = v.frizz, wavelength = 0.02, shape = 0.6, keep_length = false,
            flyaways = 0.02, flyaway = 1.6 }
        hair:cut{ ellipsoid = { center = { 0, 0.04, -0.015 }, radii = { 0.043 + h, 0.042 + h, 0.062 + h } },
            scalp = scalp, jitter = v.ragged }
        hair:push_out{ head = style }
        styling.thin_out(styling.set_width(hair, 0.0002))
        return style, hair, { color = "#33241b", clump_tone = 0.15, primary = 0.07, secondary = 0.3,
            scalp_tint = 0.9, unit = scalp:unit() }
    end,
})
