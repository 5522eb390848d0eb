--- Slicked back: wet-looking hair that is combed from the hairline over the head to the nape.
--
--     lissom run scripts/presets/slick_back.lua --length 0.09
local lissom = require "lissom"
local styling = require "styling"

-- All go on down the nape, ever closer to it: one that ended there would part the hair below its end.
local routes = {
    { { 0, 37, 3 }, { 0, 52, 9 }, { 0, 75, 8 }, { 180, 70, 7 }, { 180, 35, 8 }, { 180, 4, 7 },
        { 180, -18, 5 }, { 180, -34, 3 }, { 180, -50, 2 }, stop = false },
    { { 22, 38, 3 }, { 26, 52, 9 }, { 50, 66, 8 }, { 120, 60, 7 }, { 155, 30, 8 }, { 160, 2, 7 },
        { 163, -18, 5 }, { 166, -34, 3 }, { 168, -50, 2 }, stop = false },
    { { 44, 36, 3 }, { 56, 44, 8 }, { 85, 46, 8 }, { 120, 36, 7 }, { 140, 10, 7 }, { 148, -18, 5 },
        { 154, -36, 3 }, { 157, -50, 2 }, stop = false },
    { { 60, 22, 3 }, { 74, 30, 5 }, { 95, 31, 6 }, { 116, 22, 7 }, { 134, 0, 6 }, { 143, -26, 4 },
        { 148, -48, 2 }, stop = false },
    { { 112, -12, 2 }, { 124, -22, 3 }, { 134, -36, 3 }, { 142, -50, 2 }, stop = false },
    { { 70, 4, 3 }, { 76, 16, 4 }, { 88, 22, 5 }, { 104, 22, 6 }, { 122, 8, 5 }, { 134, -14, 4 },
        { 141, -40, 2 }, stop = false },
}

return styling.preset(..., {
    name = "slick_back",
    edge = "tied",
    schema = {
        length = { type = "number", default = 0.088, min = 0.05, max = 0.12, unit = "metres",
            help = "of the ends below the middle of the head" },
        volume = { type = "number", default = 0.006, min = 0, max = 0.02, unit = "metres",
            help = "thickness of the hair" },
        locks = { type = "integer", default = 900, min = 100, max = 3000,
            help = "number of the strands of a comb" },
        ragged = { type = "number", default = 0.02, min = 0, max = 0.03, unit = "metres",
            help = "of the ends" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local style = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = o.resolution })
        styling.streams(style, routes)
        local hair = style:grow{ count = o.count, seed = v.seed, length = 0.11, layer = v.volume,
            clearance = 0.0015, lift = 0.3, variation = 0.2 }
        local hem = {}
        for azimuth = 96, 180, 2 do
            -- Rounded at the nape, deepest in the middle.
            local low = v.length * (0.9 + 0.14 * styling.smooth(124, 176, azimuth))
            hem[#hem + 1] = { azimuth, 0.012 - (low + 0.012) * styling.smooth(94, 126, azimuth) }
        end
        hair:guides{ count = v.locks }
        hair:cut{ hem = hem, scalp = scalp, jitter = v.ragged / 2, guide_jitter = v.ragged / 2,
            seed = v.seed }
        hair:smooth{ iterations = 3 }:clump{ strength = 0.7, shape = 0.7 }
        hair:noise{ amplitude = 0.0013, across = 0.005, along = 0.12, seed = 7 }
        styling.finish(hair, 0.00026, 0.001):push_out{ head = style, clearance = 0.001 }
        return style, hair, { color = "#38241a", primary = 0.16, primary_exponent = 24, shift_jitter = 0.16,
            unit = scalp:unit() }
    end,
})
