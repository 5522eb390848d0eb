--- Finger waves: hair from a side parting lies close to the head in ridges that run round it.
--
--     lissom run examples/hair/finger_waves.lua --ridge 0.05 --depth 0.006
local styling = require "styling"

local parting = { { -24, 37 }, { -30, 50 }, { -44, 62 }, { -70, 68 } }

local streams = {
    { { -10, 46, 5 }, { 18, 42, 8 }, { 46, 28, 8 }, { 66, 6, 8 }, { "by", 2, -40, -8 }, one = true },
    { { -10, 68, 6 }, { 50, 62, 9 }, { 82, 32, 9 }, { 90, 2, 9 }, { "by", 0, -40, -4 }, one = true },
    { { -38, 42, 4 }, { -56, 28, 7 }, { -70, 6, 8 }, { "by", -2, -40, -6 }, one = true },
    { { -76, 60, 5 }, { -88, 34, 8 }, { -94, 4, 9 }, { "by", -1, -40, -2 }, one = true },
    { { 180, 68, 5 }, { 180, 34, 9 }, { 180, 0, 9 }, { 180, -34, 10 } },
    { { 130, 66, 6 }, { 128, 32, 9 }, { 128, 0, 9 }, { "by", -4, -40, 2 } },
}

return styling.preset(..., {
    name = "finger_waves",
    schema = {
        ridge = { type = "number", default = 0.046, min = 0.025, max = 0.09, unit = "metres",
            help = "from one ridge to the next" },
        depth = { type = "number", default = 0.006, min = 0, max = 0.012, unit = "metres",
            help = "how far a wave sways" },
        length = { type = "number", default = 0.07, min = 0.03, max = 0.12, unit = "metres",
            help = "of the ends below the middle of the head" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local style = styling.long(head, o, streams, parting)
        local hair = style:grow{ count = o.count, seed = v.seed, length = 0.24, layer = 0.004,
            clearance = 0.002 }
        hair:resample{ step = 0.004 }:smooth{ iterations = 4 }
        hair:cut{ hem = { { 0, -v.length } }, scalp = scalp, jitter = 0.003 }
        -- Ridges are as far from the parting everywhere: turns begin with the way of a root from it.
        local unit, top = scalp:unit(), scalp:to_metres(scalp:at{ azimuth = -38, elevation = 60 })
        local function way(_, x, y, z)
            local p, dot = scalp:to_metres(x / unit, y / unit, z / unit), 0
            for k = 1, 3 do dot = dot + p[k] * top[k] end
            return 0.1 * math.acos(dot / math.sqrt((p[1] ^ 2 + p[2] ^ 2 + p[3] ^ 2)
                * (top[1] ^ 2 + top[2] ^ 2 + top[3] ^ 2))) / v.ridge
        end
        hair:wave{ radius = v.depth, wavelength = v.ridge, start = 0, ramp = 0.02, phase = 0, variation = 0,
            tip = 1, depth = 0.5, hand = "right", begin = way, keep_length = false, seed = v.seed }
        hair:cull{ mask = styling.over_face(scalp, hair) }
        hair:push_out{ head = style, clearance = 0.0015 }
        styling.set_width(hair, 0.00026):taper{ tip = 0.5, start = 0.7 }
        return style, hair, { color = "#3a2417", unit = scalp:unit() }
    end,
})
