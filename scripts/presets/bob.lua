--- A bob with a fringe: straight hair to the chin, cut along a hem.
--
--     lissom run scripts/presets/bob.lua --length 0.09 --fringe 0.03
local lissom = require "lissom"
local styling = require "styling"

local routes = {
    { { 0, 66, 10 }, { 0, 48, 15 }, { 0, 38, 15 }, { "by", 0, -25, 4 }, { "by", 0, -25, -2 } },
    { { 16, 64, 10 }, { 17, 46, 15 }, { 19, 36, 15 }, { "by", 1, -25, 3 }, { "by", 0, -25, -3 } },
    { { 34, 60, 10 }, { 36, 42, 15 }, { 38, 33, 15 }, { "by", 3, -25, 1 }, { "by", 0, -25, -4 } },
    { { 52, 56, 10 }, { 62, 38, 18 }, { 72, 16, 22 }, { 78, 2, 25 }, { "by", 0, -50, 0 }, { "by", -6, -60,
        4 } },
    { { 84, 66, 12 }, { 86, 38, 21 }, { 88, 8, 28 }, { "by", 0, -50, 2 }, { "by", -8, -70, 4 } },
    { { 120, 72, 12 }, { 108, 42, 21 }, { 108, 5, 26 }, { "by", 0, -60, 2 }, { "by", -10, -70, 8 } },
    { { 155, 68, 10 }, { 140, 35, 20 }, { 137, -5, 22 }, { 140, -35, 20 }, { "by", -4, -60, 8 } },
    { { 166, 66, 9 }, { 161, 25, 20 }, { 160, -15, 22 }, { "by", -1, -50, 8 }, { "by", -2, -50, 11 } },
    { { 180, 66, 8 }, { 180, 25, 20 }, { 180, -15, 22 }, { "by", 0, -50, 8 }, { "by", 0, -50, 12 } },
}

return styling.preset(..., {
    name = "bob",
    edge = "loose",
    schema = {
        length = { type = "number", default = 0.112, min = 0.04, max = 0.16, unit = "metres",
            help = "of the hem below the middle of the head" },
        fringe = { type = "number", default = 0.024, min = -0.02, max = 0.06, unit = "metres",
            help = "of the fringe's ends above the middle of the head" },
        ragged = { type = "number", default = 0.007, min = 0, max = 0.02, unit = "metres",
            help = "of the hem" },
        curl = { type = "number", default = 0, min = 0, max = 1, help = "how far the ends roll in" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local style = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = o.resolution })
        styling.streams(style, routes)
        local full = styling.by_angles(scalp, function(azimuth, elevation)
            return math.abs(azimuth) < 42 and elevation < 72 and 1 or 0.7
        end)
        local hair = style:grow{ count = o.count, seed = v.seed, length = 0.27, layer = 0.01, ramp = 0.05,
            density = full }
        hair:resample{ step = 0.006 }:smooth{ iterations = 3 }:guides{ count = 700 }
        local hem = {}
        for azimuth = 32, 52, 2 do
            hem[#hem + 1] = { azimuth, v.fringe - (v.fringe + v.length) * styling.smooth(34, 50, azimuth) }
        end
        styling.ragged_hem(hair, scalp, hem, v.ragged, v.seed)
        hair:clump{ strength = 0.4, shape = 2.5, tip_spread = 0.002, seed = v.seed }
        if v.curl > 0 then hair:roll{ radius = 0.03, start = 0.8, factor = v.curl } end
        styling.finish(hair, 0.0003, 0.001):push_out{ head = style, clearance = 0.001 }
        return style, hair, { unit = scalp:unit() }
    end,
})
