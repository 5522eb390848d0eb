--- A French braid: hair is fed from both sides into a braid that begins above the forehead, runs over the
-- crown and hangs down from the nape.
--
--     lissom run examples/hair/french_braid.lua --radius 0.011 --tail 0.2
local lissom = require "lissom"
local styling = require "styling"

-- Elevation of the middle of the head `t` of the way from the forehead, 0, to the nape, 1.
local function middle(t)
    local along = 58 + (208 - 58) * t
    return along <= 90 and 0 or 180, along <= 90 and along or 180 - along
end

-- Streams from the hairline on both sides up and back to the middle.
local function streams(style)
    styling.streams(style, {
        { { 0, 37, 2 }, { 0, 47, 6 }, { 0, 58, 9 }, stop = 0.01 },
        { { 24, 36, 2 }, { 20, 52, 7 }, { 6, 72, 9 }, stop = 0.01 },
        { { 48, 28, 2 }, { 60, 50, 8 }, { 110, 80, 10 }, stop = 0.01 },
        { { 68, 14, 2 }, { 88, 40, 9 }, { 162, 66, 10 }, stop = 0.01 },
        { { 84, 26, 2 }, { 110, 38, 9 }, { 172, 44, 10 }, stop = 0.01 },
        { { 112, 6, 2 }, { 130, 20, 9 }, { 174, 22, 10 }, stop = 0.01 },
        { { 124, -20, 2 }, { 146, -8, 8 }, { 176, -4, 10 }, stop = 0.01 },
        { { 150, -38, 2 }, { 164, -30, 8 }, { 178, -26, 10 }, stop = 0.01 },
    })
end

return styling.preset(..., {
    name = "french_braid",
    schema = {
        radius = { type = "number", default = 0.011, min = 0.006, max = 0.015, unit = "metres",
            help = "of each of its three strands" },
        tail = { type = "number", default = 0.18, min = 0.05, max = 0.4, unit = "metres",
            help = "length of the braid below the nape" },
    },
    make = function(head, v, o)
        local scalp, places = o.scalp, {}
        local style = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = o.resolution })
        streams(style)
        for i = 0, 24 do
            local azimuth, elevation = middle(i / 24)
            places[#places + 1] = { azimuth, elevation, 6 + 4 * math.min(1, i / 6) }
        end
        for _ = 1, 8 do places[#places + 1] = { "by", 0, -125 * v.tail, -10 * v.tail } end
        local hair = style:grow{ count = o.count, seed = v.seed, length = 0.2, layer = 0.004,
            clearance = 0.002 }
        hair:resample{ step = 0.004 }:smooth{ iterations = 2 }
        hair:feed_braid{ spine = styling.route(scalp, places), scalp = scalp, across = scalp:left(),
            radius = v.radius, wide = 1.4 * v.radius, high = 0.7 * v.radius, wavelength = 6.5 * v.radius,
            joined = 0.7, tail = 0.6, begin_size = 0.5, end_size = 0.6, min_run = 0.1, max_run = 0.4,
            seed = v.seed, drop_others = true }
        styling.finish(hair, 0.00024, 0.0006):push_out{ head = style, clearance = 0.0015 }
        return style, hair, { color = "#6b4a2f", unit = scalp:unit() }
    end,
})
