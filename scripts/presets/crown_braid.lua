--- A crown braid: hair is fed into a braid that rings the head.
--
--     lissom run scripts/presets/crown_braid.lua --radius 0.01
local lissom = require "lissom"
local styling = require "styling"

-- Elevation of the ring: high in front, low behind.
local function ring_at(azimuth, height)
    return height - 24 * styling.smooth(20, 110, math.abs((azimuth + 180) % 360 - 180))
end

-- Streams from the crown and from the hairline up to the ring, close behind the ears, where it falls.
local function streams(style, height)
    local routes = {}
    for azimuth = -165, 180, 15 do
        local ring, low = ring_at(azimuth, height), styling.hairline_at(azimuth) + 3
        routes[#routes + 1] = { { azimuth, 80, 4 }, { azimuth, (80 + ring) / 2, 8 }, { azimuth, ring + 3, 9 },
            stop = 0.02, one = true }
        if ring - low > 6 then
            routes[#routes + 1] = { { azimuth, low, 2 }, { azimuth, 0.6 * low + 0.4 * ring, 5 },
                { azimuth, ring - 3, 9 }, stop = 0.02, one = true }
        end
    end
    styling.streams(style, routes)
end

return styling.preset(..., {
    name = "crown_braid",
    edge = "tied",
    schema = {
        height = { type = "number", default = 50, min = 40, max = 60, unit = "degrees",
            help = "elevation of the braid in front" },
        radius = { type = "number", default = 0.0078, min = 0.005, max = 0.012, unit = "metres",
            help = "of each of its three strands" },
        turn = { type = "number", default = 0.06, min = 0.03, max = 0.1, unit = "metres",
            help = "length of one turn of a strand" },
        loose = { type = "number", default = 0.02, min = 0, max = 0.2,
            help = "part of the hair that lies loosely" },
    },
    make = function(head, v, o)
        local scalp, spine = o.scalp, {}
        local style = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = o.resolution })
        streams(style, v.height)
        for azimuth = -180, 330, 10 do
            local a = (azimuth + 180) % 360 - 180
            spine[#spine + 1] = scalp:at{ azimuth = a, elevation = ring_at(a, v.height), lift = 0.005 }
        end
        local hair = style:grow{ count = o.count, seed = v.seed, length = 0.16, layer = 0.005,
            clearance = 0.002 }
        hair:resample{ step = 0.004 }:smooth{ iterations = 2 }
        hair:feed_braid{ spine = spine, scalp = scalp, across = scalp:up(), radius = v.radius,
            wide = 1.15 * v.radius, high = 0.7 * v.radius, wavelength = v.turn, joined = 0.7, loose = v.loose,
            seed = v.seed, drop_others = true }
        hair:frizz{ amplitude = 0.0005, wavelength = 0.02 }
        styling.finish(hair, 0.00024, 0.0005):push_out{ head = style, clearance = 0.0015 }
        return style, hair, { color = "#c09a5c", unit = scalp:unit() }
    end,
})
