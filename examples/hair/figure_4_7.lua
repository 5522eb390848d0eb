-- A hairstyle with a parting (Figure 4.7): seven stream curves and one dividing curve.
--
--     lissom run examples/hair/figure_4_7.lua
--     lissom run examples/hair/figure_4_7.lua --fidelity thesis
--     lissom run examples/hair/figure_4_7.lua --head ict_head.obj --count 20000

local hairdo = require "hairdo"
local strokes = require "strokes"

local params = hairdo.params{ name = "figure_4_7", more = { fidelity = hairdo.fidelity } }
local by = strokes.by

local head = hairdo.head(params)
local style = hairdo.style(head, params, { fidelity = params.fidelity })
local route = strokes.route(style)

style:add_dividing{
    points = route{ { -22, 37 }, { -28, 52 }, { -42, 68 }, { -70, 76 } },
    tilt = { 15, 0 },
    name = "parting",
}

local streams = {
    { { -4, 47, 14 }, { 25, 42, 20 }, { 52, 30, 18 }, { 71, 8, 18 }, by(4, -50, -4), by(-4, -60, -4) },
    { { 0, 72, 14 }, { 60, 62, 18 }, { 84, 32, 20 }, { 92, 5, 22 }, by(5, -50, 0), by(-4, -60, 0) },
    { { -40, 42, 8 }, { -60, 27, 14 }, { -77, 5, 16 }, by(-4, -50, -4), by(4, -60, -4) },
    { { -74, 62, 10 }, { -90, 35, 18 }, { -95, 5, 20 }, by(-5, -50, 0), by(4, -60, 0) },
    { { 180, 70, 10 }, { 180, 35, 20 }, { 180, -5, 22 }, { 180, -35, 20 }, by(0, -60, 0) },
    { { 130, 68, 12 }, { 126, 32, 20 }, { 126, -5, 22 }, by(2, -50, 0), by(-2, -60, 0) },
    { { -130, 68, 12 }, { -126, 32, 20 }, { -126, -5, 22 }, by(-2, -50, 0), by(2, -60, 0) },
}
for i, places in ipairs(streams) do
    style:add_stream{ points = route(places), name = "stream " .. i }
end

local hair = hairdo.grow(style, params, {
    length = 0.25,
    layer = 0.012,
    cut = { point = style:scalp():from_metres(0, -0.125, 0), ragged = 0.006 },
})
hairdo.finish(style, hair, params)
