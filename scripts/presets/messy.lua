--- Short messy hair: off one whorl, in locks that lean.
--
--     lissom run scripts/presets/messy.lua --length 0.09 --disorder 0.03
local lissom = require "lissom"
local styling = require "styling"

-- From one whorl outwards, so that no lock ends against another; in front towards the head's left.
local routes = {
    { { 180, 65, 2 }, { 0, 86, 16 }, { 4, 70, 22 }, { 10, 54, 28 }, { 16, 40, 30 }, { 18, 30, 28 },
        one = true },
    { { 173, 65, 2 }, { 72, 72, 16 }, { 40, 60, 22 }, { 36, 47, 28 }, { 38, 36, 28 }, one = true },
    { { -173, 65, 2 }, { -72, 72, 16 }, { -30, 60, 22 }, { -18, 47, 28 }, { -10, 36, 28 }, one = true },
    { { 169, 63, 2 }, { 92, 60, 15 }, { 64, 48, 21 }, { 54, 37, 26 }, { 52, 25, 24 } },
    { { 168, 61, 2 }, { 104, 46, 14 }, { 88, 29, 18 }, { 80, 12, 22 }, { 78, -8, 20 } },
    { { 169, 59, 2 }, { 122, 36, 14 }, { 108, 16, 18 }, { 100, -4, 20 }, { 98, -24, 16 } },
    { { 172, 57, 2 }, { 138, 26, 14 }, { 130, 4, 18 }, { 128, -20, 18 }, { 128, -40, 10 } },
    { { 180, 56, 2 }, { 180, 26, 14 }, { 180, -2, 18 }, { 180, -22, 16 }, { 180, -42, 8 } },
}

return styling.preset(..., {
    name = "messy",
    edge = "short",
    schema = {
        length = { type = "number", default = 0.07, min = 0.03, max = 0.12, unit = "metres",
            help = "on top" },
        disorder = { type = "number", default = 0.02, min = 0, max = 0.05, unit = "metres",
            help = "how far hair wanders" },
        locks = { type = "integer", default = 420, min = 50, max = 3000, help = "number of locks" },
        gathered = { type = "number", default = 0.75, min = 0, max = 1, help = "how closely a lock gathers" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local style = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = o.resolution })
        styling.streams(style, routes)
        local lengths = styling.by_angles(scalp, function(_, elevation)
            return v.length * (0.5 + 0.5 * styling.smooth(-20, 50, elevation))
        end)
        local hair = style:grow{ count = o.count, seed = v.seed, length = lengths, layer = 0.014,
            clearance = 0.002, lift = 0.6, variation = 0.35, min_speed = 0.01 }
        hair:resample{ count = 18 }:smooth{ iterations = 2 }
        hair:noise{ amplitude = v.disorder, across = 0.02, along = 0.06, seed = 4 + v.seed, shape = 1.2 }
        hair:clump{ clumps = v.locks, strength = v.gathered, tip_spread = 0.0025, offset = 0.006 }
        hair:clump{ clumps = 1600, strength = 0.3 }
        styling.finish(hair, 0.00028, 0.003):push_out{ head = style, clearance = 0.002 }
        return style, hair, { color = "#6b4325", unit = scalp:unit() }
    end,
})
