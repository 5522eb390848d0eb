--- A faux hawk: short sides, and hair on top that is combed up to a ridge from the forehead to the crown.
--
--     lissom run examples/hair/faux_hawk.lua --height 0.05
local lissom = require "lissom"
local styling = require "styling"

-- Streams of the top: from the middle up, and from its edges up and inwards, highest in front.
local function ridge(style, height)
    for along = 40, 140, 14 do
        local azimuth, elevation = along <= 90 and 0 or 180, along <= 90 and along or 180 - along
        local up = 1000 * height * (1 - 0.5 * styling.smooth(60, 140, along))
        styling.streams(style, { { { azimuth, elevation, 2 }, { azimuth, elevation + 5, up / 2 },
            { azimuth, elevation + 8, up } } })
        local spread = math.min(80, 26 / math.max(0.2, math.cos(math.rad(elevation))))
        local side = azimuth == 0 and spread or 180 - spread
        local inner = azimuth == 0 and 0.4 * spread or 180 - 0.4 * spread
        styling.streams(style, { { { side, elevation - 4, 2 }, { (side + inner) / 2, elevation + 3, up / 2 },
            { inner, elevation + 6, up } } })
    end
end

return styling.preset(..., {
    name = "faux_hawk",
    schema = {
        height = { type = "number", default = 0.045, min = 0.015, max = 0.09, unit = "metres",
            help = "of the ridge above the forehead" },
        sides = { type = "number", default = 0.009, min = 0.002, max = 0.03, unit = "metres",
            help = "length of the hair beside it" },
        width = { type = "number", default = 0.1, min = 0.05, max = 0.14, unit = "metres",
            help = "of the hair on top" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        -- 0 on top, 1 at the sides and behind.
        local beside = styling.by_angles(scalp, function(azimuth, elevation, p)
            local back = math.abs(azimuth) > 90 and 1 - styling.smooth(-5, 40, elevation) or 0
            return math.max(back, styling.smooth(0.4 * v.width, 0.56 * v.width, math.abs(p[1])))
        end)
        local _, hair = styling.stubble(head, o, { part = 1, seed = v.seed, density = beside,
            length = v.sides })
        local style = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = o.resolution })
        ridge(style, v.height)
        local lengths = styling.by_angles(scalp, function(azimuth, elevation)
            local behind = math.abs(azimuth) > 90 and styling.smooth(0, 75, elevation) or 1
            return v.height * (0.5 + 0.5 * behind)
        end)
        local top = style:grow{ count = math.floor(0.6 * o.count), seed = v.seed + 1, length = lengths,
            density = function(...) return 1 - beside(...) end, layer = 0.001, clearance = 0.0012,
            lift = 0.7, variation = 0.2 }
        top:resample{ count = 12 }:clump{ clumps = 260, strength = 0.75, shape = 0.8, tip_spread = 0.002 }
        top:push_out{ head = style, clearance = 0.001 }
        hair:append(styling.finish(top, 0.00026, 0.003, o.count))
        return style, hair, { color = "#2d2018", unit = scalp:unit() }
    end,
})
