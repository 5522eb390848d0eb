-- Two ponytails (Figure 4.8): hair is gathered at both sides of the head by streams that lead into the ties.
--
--     lissom run examples/hair/figure_4_8.lua
--     lissom run examples/hair/figure_4_8.lua --fidelity thesis
--     lissom run examples/hair/figure_4_8.lua --head ict_head.obj --count 20000

local hairdo = require "hairdo"
local strokes = require "strokes"

local params = hairdo.params{ name = "figure_4_8", more = { fidelity = hairdo.fidelity } }

local head = hairdo.head(params)
local style = hairdo.style(head, params, { fidelity = params.fidelity })
local route = strokes.route(style)

local rings = {}
for i, side in ipairs{ 1, -1 } do
    local tail = { azimuth = 118 * side, elevation = 14, lift = 0.02, length = 0.25, droop = 0.04,
        radius = 0.017 }
    style:add_ponytail{
        spine = hairdo.tail_spine(style:scalp(), tail),
        radius = tail.radius,
        fullness = 0.7,
        tail_length = tail.length,
        name = side > 0 and "left tail" or "right tail",
    }
    rings[i] = hairdo.ring(style:scalp(), tail)
end
strokes.both_sides({
    { { 6, 39, 4 }, { 32, 52, 8 }, { 72, 44, 9 }, { 98, 28, 10 }, { 113, 16, 18 } },
    { { 172, -30, 4 }, { 163, -8, 7 }, { 145, 8, 10 }, { 125, 14, 18 } },
}, function(places) style:add_stream{ points = route(places), stop = false } end)

local hair = hairdo.grow(style, params, { length = 0.5, layer = 0.008 })
hairdo.finish(style, hair, params, rings)
