-- Two ponytails (Figure 4.8): hair is gathered at both sides of the head by streams that lead into the ties.
--
--     lissom run examples/hair/figure_4_8.lua
--     lissom run examples/hair/figure_4_8.lua --head ict_head.obj --count 20000

local hairdo = require "hairdo"
local strokes = require "strokes"

local params = hairdo.params{ name = "figure_4_8" }

local head = hairdo.head(params)
local style = hairdo.style(head, params)
local route = strokes.route(style)

for _, side in ipairs{ 1, -1 } do
    style:ponytail{
        spine = hairdo.tail_spine(style:scalp(),
            { azimuth = 118 * side, elevation = 14, lift = 0.02, length = 0.25, droop = 0.045 }),
        radius = 0.016,
        share = 0.7,
        fullness = 0.9,
        outer = 3,
        tail_length = 0.25,
        name = side > 0 and "left tail" or "right tail",
    }
end
strokes.both_sides({
    { { 6, 39, 4 }, { 32, 52, 8 }, { 72, 44, 9 }, { 98, 28, 10 }, { 113, 16, 18 } },
    { { 172, -30, 4 }, { 163, -8, 7 }, { 145, 8, 10 }, { 125, 14, 18 } },
}, function(places) style:stream{ points = route(places), stop = false } end)

local hair = style:grow{ count = params.count, length = 0.5, layer = 0.008 }
hairdo.finish(style, hair, params)
