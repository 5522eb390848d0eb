--- Half up: the upper hair is wound to a bun over loose waves of the rest.
--
--     lissom run scripts/presets/half_up.lua --length 0.2 --bun 0.02
local ponytails = require "ponytails"
local styling = require "styling"

-- The lower hair begins below the line that parts it from the upper.
local routes = {
    { { 60, 30, 3 }, { 72, 18, 9 }, { 80, 2, 15 }, { "at", 86, -60, 22 }, { "at", 82, -115, -20 },
        { "at", 76, -170, -80 }, { "at", 72, -220, -106 }, { "at", 70, -360, -110 } },
    { { 80, 32, 4 }, { 90, 20, 10 }, { 96, 2, 16 }, { "at", 92, -60, -18 }, { "at", 76, -120, -58 },
        { "at", 66, -190, -104 }, { "at", 62, -360, -112 } },
    { { 122, 26, 5 }, { 122, -5, 15 }, { "at", 70, -80, -66 }, { "at", 54, -130, -84 },
        { "at", 46, -190, -108 }, { "at", 44, -360, -114 } },
    { { 155, 22, 4 }, { 154, -28, 15 }, { "at", 34, -130, -88 }, { "at", 30, -200, -108 }, { "at", 28, -360,
        -114 } },
    { { 180, 20, 4 }, { 180, -30, 15 }, { "at", 0, -130, -92 }, { "at", 0, -200, -110 },
        { "at", 0, -360, -116 } },
}

return styling.preset(..., {
    name = "half_up",
    edge = "tied",
    schema = {
        length = { type = "number", default = 0.28, min = 0.1, max = 0.34, unit = "metres",
            help = "of the ends below the middle of the head" },
        line = { type = "number", default = 33, min = 24, max = 42, unit = "degrees",
            help = "elevation of the line between upper and lower hair in front" },
        bun = { type = "number", default = 0.0155, min = 0.01, max = 0.025, unit = "metres",
            help = "radius of the bun" },
        wave = { type = "number", default = 0.008, min = 0, max = 0.015, unit = "metres",
            help = "radius of the waves" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local function upper(azimuth, elevation)
            local line = v.line - 9 * styling.smooth(100, 180, math.abs(azimuth))
            return styling.smooth(line - 5, line + 5, elevation)
        end
        local low = styling.long(head, o, routes)
        local hair = low:grow{ count = math.floor(0.8 * o.count), seed = v.seed, length = 0.225 + v.length,
            layer = 0.01, clearance = 0.003,
            density = styling.by_angles(scalp, function(...) return 1 - upper(...) end) }
        styling.wavy(hair, scalp, v.length, { locks = 140, factor = 0.4, ragged = 0.012, clump = 0.55,
            wave = { radius = v.wave, wavelength = 0.095, start = 0.03, ramp = 0.12, depth = 0.35,
                seed = v.seed } })
        hair:push_out{ head = low, clearance = 0.003 }
        local style, up, tie = ponytails.grow(head,
            { height = 38, tightness = 0.75, length = 0.05, lift = 0.016, seed = v.seed },
            { scalp = scalp, resolution = o.resolution, hard = true },
            { count = math.floor(0.7 * o.count), density = styling.by_angles(scalp, upper),
                seed = v.seed + 101 })
        ponytails.wind(up, scalp, tie, v.bun, { tube = 1.13 * v.bun, seed = v.seed })
        up:frizz{ amplitude = 0.001, wavelength = 0.03, flyaway = 5 }:push_out{ head = style,
            clearance = 0.001 }
        styling.finish(hair:append(up), 0.00026, 0.001)
        return style, hair, { color = "#7a4a26", unit = scalp:unit() }
    end,
})
