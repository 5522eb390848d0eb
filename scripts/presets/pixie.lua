--- A pixie cut: short soft hair that is combed forwards, its fringe swept to one side.
--
--     lissom run scripts/presets/pixie.lua --fringe 0.08 --nape 0.02
local lissom = require "lissom"
local styling = require "styling"

-- From the crown on the head's right to the front on its left, over the temples forwards, down at the nape.
local combed = {
    { -34, 62, 14, 40, 12, one = true }, { -14, 50, 24, 34, 11, one = true },
    { 8, 46, 38, 30, 11, one = true }, { 28, 44, 52, 24, 10, one = true },
    { -50, 66, -16, 52, 13, one = true }, { -44, 46, -40, 26, 8, one = true },
    { -62, 44, -52, 18, 7, one = true }, { 48, 46, 58, 16, 8, one = true },
    { 100, 60, 74, 26, 11 }, { 88, 36, 72, 6, 9 }, { 96, 16, 82, -12, 8 }, { 66, 20, 62, -4, 6 },
    { 124, 46, 116, 8, 12 }, { 126, 6, 116, -24, 8 }, { 180, 66, 180, 34, 14 }, { 180, 34, 180, 2, 12 },
    { 150, 40, 148, 4, 12 }, { 180, 0, 176, -34, 6 }, { 146, -4, 142, -34, 6 },
    { 180, -32, 180, -58, 3 }, { 152, -32, 150, -56, 3 }, { 126, -22, 126, -46, 3 },
}

return styling.preset(..., {
    name = "pixie",
    edge = "short",
    schema = {
        fringe = { type = "number", default = 0.072, min = 0.02, max = 0.1, unit = "metres",
            help = "length of the fringe" },
        sides = { type = "number", default = 0.045, min = 0.015, max = 0.07, unit = "metres",
            help = "length beside the ears" },
        nape = { type = "number", default = 0.014, min = 0.004, max = 0.05, unit = "metres",
            help = "length at the nape" },
        locks = { type = "integer", default = 500, min = 50, max = 3000, help = "number of locks" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local style = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = o.resolution })
        styling.comb(style, combed)
        local lengths = styling.by_angles(scalp, function(azimuth, elevation)
            local back = styling.smooth(95, 150, math.abs(azimuth))
            local low = v.sides + (v.nape - v.sides) * back
            -- At the back it is layered: hair of one length would hang over the nape like a bowl.
            local high = v.fringe * (1 - 0.4 * back)
            return low + (high - low) * styling.smooth(-8 - 22 * back, 44 + 26 * back, elevation)
        end)
        local hair = style:grow{ count = o.count, seed = v.seed, length = lengths, layer = 0.008,
            clearance = 0.0015, lift = 0.35, variation = 0.4,
            segment = 0.3, min_speed = 0.01 }
        hair:resample{ count = 16 }:smooth{ iterations = 2 }
        hair:clump{ clumps = v.locks, strength = 0.6, tip_spread = 0.0015, offset = 0.002, seed = v.seed }
        styling.finish(hair, 0.00028, 0.003):push_out{ head = style, clearance = 0.0015 }
        return style, hair, { color = "#5d3a22", unit = scalp:unit() }
    end,
})
