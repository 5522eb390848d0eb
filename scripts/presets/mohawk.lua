--- A mohawk: a fin of standing hair between shaved sides.
--
--     lissom run scripts/presets/mohawk.lua --height 0.11 --width 0.03
local lissom = require "lissom"
local styling = require "styling"

-- Streams of the fin: from the middle and both of its edges up into one plane.
local function fin(style, width)
    local spread = math.deg(math.asin(math.min(0.9, width / 0.17)))
    local function add(azimuth, elevation, rise)
        local side = spread / math.cos(math.rad(elevation))
        for _, a in ipairs{ 0, side } do
            local function at(part) return azimuth == 0 and part * a or 180 - part * a end
            styling.streams(style, { { { at(1), elevation, 2 }, { at(0.75), elevation + rise, 40 },
                { at(0.5), elevation + 1.5 * rise, 100 } } })
        end
    end
    for _, elevation in ipairs{ 36, 48, 60, 75 } do add(0, elevation, 4) end
    for _, elevation in ipairs{ 80, 60, 40, 20, 0, -20, -36 } do add(180, elevation, 5) end
end

return styling.preset(..., {
    name = "mohawk",
    edge = "short",
    schema = {
        height = { type = "number", default = 0.085, min = 0.02, max = 0.12, unit = "metres",
            help = "of the fin" },
        width = { type = "number", default = 0.044, min = 0.015, max = 0.08, unit = "metres",
            help = "of the fin" },
        sides = { type = "number", default = 0.004, min = 0.001, max = 0.02, unit = "metres",
            help = "length of the hair beside it" },
        spikes = { type = "integer", default = 90, min = 10, max = 600, help = "locks of the fin" },
    },
    make = function(head, v, o)
        local scalp, half = o.scalp, v.width / 2
        local function beside(low, high)
            return styling.by_angles(scalp, function(_, _, p)
                return styling.smooth(low, high, math.abs(p[1]))
            end)
        end
        local sides = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = o.resolution })
        styling.comb(sides, { { 0, 75, 0, 52, 11 }, { 25, 62, 20, 40, 10 }, { 45, 50, 46, 30, 6 },
            { 80, 36, 84, 12, 4 }, { 82, 12, 86, -8, 3 }, { 180, 48, 180, 18, 5 }, { 140, 45, 140, 12, 5 },
            { 180, 4, 180, -28, 3 }, { 130, 0, 132, -28, 3 } })
        local hair = sides:grow{ count = math.floor(0.6 * o.count), seed = v.seed, length = v.sides,
            layer = 0.001, clearance = 0.0012, lift = 1, variation = 0.15, segment = 0.1,
            density = beside(half - 0.003, half) }
        styling.set_width(hair:resample{ count = 5 }, 0.00024, o.count)
        hair:set_colors{ color = { 0.04, 0.028, 0.02 } }
        local style = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = o.resolution,
            volume = { min = { -0.12, -0.2, -0.24 }, max = { 0.12, 0.28, 0.22 } } })
        fin(style, v.width)
        local lengths = styling.by_angles(scalp, function(azimuth, elevation)
            return v.height * (math.abs(azimuth) < 90 and 1 or 0.53 + 0.53 * styling.smooth(-40, 70,
                elevation))
        end)
        local inside = beside(half, half + 0.003)
        local top = style:grow{ count = math.floor(0.5 * o.count), seed = v.seed, length = lengths, layer = 0,
            clearance = 0.001, lift = 0.5, variation = 0.08,
            density = function(...) return 1 - inside(...) end }
        top:resample{ count = 16 }
        top:clump{ clumps = v.spikes, strength = 0.75, shape = 0.8, tip_spread = 0.003 }
        top:clump{ clumps = 600, strength = 0.3 }:push_out{ head = style }
        styling.finish(top, 0.00026, 0.004, o.count):set_colors{ color = { 0.30, 0.03, 0.05 } }
        return style, hair:append(top), { unit = scalp:unit() }
    end,
})
