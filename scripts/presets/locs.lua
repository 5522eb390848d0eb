--- Locs: ropes of matted hair, each twisted along its length.
--
--     lissom run scripts/presets/locs.lua --locs 120 --radius 0.003
local lissom = require "lissom"
local styling = require "styling"

local routes = {
    { { 5, 60, 6 }, { 24, 50, 18 }, { 47, 32, 28 }, { 68, 8, 28 }, { "at", 92, -60, 18 },
        { "at", 94, -200, 10 } },
    { { 4, 44, 6 }, { 28, 42, 18 }, { 52, 28, 26 }, { 70, 6, 28 }, { "at", 94, -60, 16 },
        { "at", 96, -200, 8 } },
    { { 30, 78, 5 }, { 66, 50, 18 }, { 84, 18, 30 }, { 90, 0, 30 }, { "at", 102, -60, -6 }, { "at", 104, -200,
        -10 } },
    { { 120, 70, 9 }, { 116, 40, 22 }, { 118, 5, 30 }, { "at", 84, -60, -70 }, { "at", 86, -200, -80 } },
    { { 150, 74, 5 }, { 150, 52, 14 }, { 150, 30, 20 }, { 150, -10, 30 }, { "at", 48, -70, -98 },
        { "at", 48, -200, -108 } },
    { { 180, 86, 4 }, { 180, 64, 12 }, { 180, 30, 20 }, { 180, -10, 30 }, { "at", 0, -80, -108 },
        { "at", 0, -200, -116 } },
}

return styling.preset(..., {
    name = "locs",
    schema = {
        length = { type = "number", default = 0.27, min = 0.08, max = 0.34, unit = "metres",
            help = "of a loc" },
        locs = { type = "integer", default = 170, min = 30, max = 600, help = "number of locs" },
        radius = { type = "number", default = 0.0035, min = 0.0015, max = 0.008, unit = "metres",
            help = "of a loc" },
        matted = { type = "number", default = 0.0003, min = 0, max = 0.002, unit = "metres",
            help = "how far single hairs stand off" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local style = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = o.resolution,
            volume = { min = { -0.17, -0.32, -0.19 }, max = { 0.17, 0.17, 0.17 } } })
        styling.streams(style, routes)
        local hair = style:grow{ count = o.count, seed = v.seed, length = v.length, layer = 0.01,
            clearance = 0.004, lift = 0.2, variation = 0.15 }
        hair:resample{ step = 0.005 }:smooth{ iterations = 4 }:guides{ count = v.locs }
        local function is_guide(strand) return hair:root(strand).guide == hair:root(strand).id end
        hair:frizz{ mask = is_guide, amplitude = 0.004, wavelength = 0.07, flyaways = 0 }
        hair:gather{ ramp = 0.012, spread = 0.4 * v.radius }
        hair:cull{ mask = styling.over_face(scalp, hair), locks = true }
        hair:twist{ wavelength = 0.016, ramp = 0.01 }
        hair:frizz{ amplitude = v.matted, wavelength = 0.006, flyaways = 0.015, flyaway = 3, shape = 0.3,
            seed = v.seed }
        hair:push_out{ head = style, clearance = 0.002 }
        styling.set_width(hair, 0.00025):taper{ tip = 0.5, start = 0.93 }
        return style, hair, { color = "#4a372a", clump_tone = 0.4, clump_size = 0.014, primary = 0.07,
            secondary = 0.35, unit = scalp:unit() }
    end,
})
