--- Short messy hair: combed all ways, in locks that lean.
--
--     lissom run scripts/presets/messy.lua --length 0.09 --disorder 0.03
local lissom = require "lissom"
local styling = require "styling"

local combed = {
    { 0, 72, 8, 46, 26 }, { 25, 62, 26, 38, 26 }, { -5, 50, -8, 32, 26, one = true }, { 28, 46, 30, 28, 24 },
    { 45, 52, 52, 26, 20 }, { 100, 66, 90, 38, 18 }, { 180, 70, 0, 86, 20 }, { 80, 36, 86, 6, 16 },
    { 60, 44, 66, 14, 16 }, { 82, 12, 90, -14, 12 }, { 180, 48, 180, 14, 18 }, { 140, 45, 140, 8, 18 },
    { 180, 4, 180, -36, 10 }, { 130, 0, 132, -36, 10 },
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
        styling.comb(style, combed)
        local lengths = styling.by_angles(scalp, function(_, elevation)
            return v.length * (0.5 + 0.5 * styling.smooth(-20, 50, elevation))
        end)
        local hair = style:grow{ count = o.count, seed = v.seed, length = lengths, layer = 0.014,
            clearance = 0.002, lift = 0.6, variation = 0.35 }
        hair:resample{ count = 18 }:smooth{ iterations = 2 }
        hair:noise{ amplitude = v.disorder, across = 0.02, along = 0.06, seed = 4 + v.seed, shape = 1.2 }
        hair:clump{ clumps = v.locks, strength = v.gathered, tip_spread = 0.0025, offset = 0.006 }
        hair:clump{ clumps = 1600, strength = 0.3 }
        styling.finish(hair, 0.00028, 0.003):push_out{ head = style, clearance = 0.002 }
        return style, hair, { color = "#6b4325", unit = scalp:unit() }
    end,
})
