--- Loose waves: long hair from a side parting over the shoulders.
--
--     lissom run scripts/presets/waves.lua --length 0.28 --radius 0.012
local lissom = require "lissom"
local styling = require "styling"

local parting = { { -22, 37 }, { -28, 52 }, { -42, 68 }, { -70, 76 } }
local routes = {
    { { 10, 50, 10 }, { 30, 40, 18 }, { 52, 25, 20 }, { 68, 5, 20 }, { "at", 80, -60, 20 },
        { "at", 80, -115, 6 }, { "at", 80, -180, 4 }, { "at", 82, -300, 10 } },
    { { 30, 72, 12 }, { 66, 50, 20 }, { 84, 18, 20 }, { 90, 0, 20 }, { "at", 88, -60, -6 },
        { "at", 84, -116, -24 }, { "at", 86, -180, -24 }, { "at", 86, -300, -20 } },
    { { 120, 70, 10 }, { 116, 40, 18 }, { 118, 5, 20 }, { "at", 74, -60, -60 }, { "at", 70, -115, -70 },
        { "at", 66, -190, -104 }, { "at", 62, -360, -112 } },
    { { 150, 66, 8 }, { 150, 30, 18 }, { 150, -10, 20 }, { "at", 44, -70, -84 }, { "at", 40, -130, -92 },
        { "at", 38, -200, -108 }, { "at", 36, -360, -114 } },
    { { 180, 70, 8 }, { 180, 30, 18 }, { 180, -10, 20 }, { "at", 0, -80, -88 }, { "at", 0, -130, -94 },
        { "at", 0, -200, -110 }, { "at", 0, -360, -116 } },
}

return styling.preset(..., {
    name = "waves",
    schema = {
        length = { type = "number", default = 0.235, min = 0.08, max = 0.33, unit = "metres",
            help = "of the ends below the middle of the head" },
        radius = { type = "number", default = 0.009, min = 0, max = 0.02, unit = "metres",
            help = "of a wave" },
        wavelength = { type = "number", default = 0.095, min = 0.03, max = 0.2, unit = "metres",
            help = "of a wave" },
        locks = { type = "integer", default = 90, min = 20, max = 600, help = "number of locks" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local style = lissom.hairstyle(head, { scalp = scalp, resolution = math.floor(1.2 * o.resolution),
            volume = { min = { -0.15, -0.42, -0.19 }, max = { 0.15, 0.16, 0.16 } } })
        style:add_dividing{ points = styling.route(scalp, parting), tilt = { 15, 0 } }
        styling.streams(style, routes)
        local hair = style:grow{ count = o.count, seed = v.seed, length = 0.225 + v.length, layer = 0.012,
            clearance = 0.004 }
        hair:resample{ step = 0.006 }:smooth{ iterations = 4 }
        hair:gather{ guides = v.locks, factor = 0.35, ramp = 0.15, spread = 0.006 }
        hair:cull{ mask = styling.over_face(scalp, hair) }
        hair:wave{ radius = v.radius, wavelength = v.wavelength, depth = 1, keep_length = false,
            seed = v.seed }
        hair:cut{ hem = { { 0, -v.length } }, scalp = scalp, jitter = 0.01, guide_jitter = 0.015 }
        hair:clump{ clumps = 700, strength = 0.5 }
        styling.finish(hair, 0.00026, 0.002):push_out{ head = style, clearance = 0.003 }
        return style, hair, { unit = scalp:unit() }
    end,
})
