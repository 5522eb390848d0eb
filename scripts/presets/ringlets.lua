--- Ringlets: long tight curls from a centre parting, straight on top, as the weight of hair draws them out.
--
--     lissom run scripts/presets/ringlets.lua --length 0.24 --curls 120
local lissom = require "lissom"
local styling = require "styling"

local parting = { { 0, 37 }, { 0, 52 }, { 0, 66 }, { 180, 82 } }
local routes = {
    { { 10, 52, 12 }, { 30, 42, 20 }, { 52, 27, 24 }, { 70, 5, 26 }, { "at", 90, -60, 14 }, { "at", 92,
        -200, 8 } },
    { { 30, 72, 14 }, { 66, 50, 24 }, { 84, 18, 28 }, { 90, 0, 30 }, { "at", 104, -60, -6 },
        { "at", 106, -200, -10 } },
    { { 120, 70, 14 }, { 116, 40, 24 }, { 118, 5, 30 }, { "at", 86, -60, -70 }, { "at", 88, -200, -80 } },
    { { 150, 66, 12 }, { 150, 30, 24 }, { 150, -10, 30 }, { "at", 48, -70, -98 }, { "at", 48, -200, -108 } },
    { { 180, 70, 12 }, { 180, 30, 24 }, { 180, -10, 30 }, { "at", 0, -80, -108 }, { "at", 0, -200, -116 } },
}

return styling.preset(..., {
    name = "ringlets",
    edge = "loose",
    schema = {
        length = { type = "number", default = 0.17, min = 0.06, max = 0.26, unit = "metres",
            help = "of the ends below the middle of the head" },
        curls = { type = "integer", default = 170, min = 20, max = 1000, help = "number of ringlets" },
        radius = { type = "number", default = 0.0095, min = 0.002, max = 0.02, unit = "metres",
            help = "of a ringlet" },
        wavelength = { type = "number", default = 0.03, min = 0.008, max = 0.12, unit = "metres",
            help = "of one turn" },
        ribbon = { type = "number", default = 0.22, min = 0, max = 1,
            help = "how far hairs of a ringlet part: .06 a wire, .2 a ribbon, .5 a coil" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local style = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = o.resolution,
            volume = { min = { -0.17, -0.32, -0.19 }, max = { 0.17, 0.17, 0.17 } } })
        style:add_dividing{ points = styling.route(scalp, parting), tilt = { 15, 0 } }
        styling.streams(style, routes)
        local hair = style:grow{ count = o.count, seed = v.seed, length = 0.11 + v.length, layer = 0.024,
            clearance = 0.006, lift = 0.2, variation = 0.12 }
        hair:resample{ step = 0.006 }:smooth{ iterations = 4 }:guides{ count = v.curls }
        local function is_guide(strand) return hair:root(strand).guide == hair:root(strand).id end
        hair:frizz{ mask = is_guide, amplitude = 0.006, wavelength = 0.12, flyaways = 0 }
        hair:gather{ factor = 0.98, ramp = 0.06, spread = 0.001 }
        hair:cull{ mask = styling.over_face(scalp, hair), locks = true }
        hair:curl{ radius = v.radius, wavelength = v.wavelength, ramp = 0.1, phase = v.ribbon,
            keep_length = false, seed = v.seed }
        hair:cut{ hem = { { 0, -v.length } }, scalp = scalp, guide_jitter = 0.03 }
        hair:frizz{ amplitude = 0.0004, wavelength = 0.02 }
        styling.finish(hair, 0.00024, 0.0008):push_out{ head = style, clearance = 0.003 }
        return style, hair, { color = "#7a3c1c", unit = scalp:unit() }
    end,
})
