-- A smooth hairstyle made with ten stream curves alone (Figure 4.6): a bob, swept to one side.
--
--     lissom run examples/hair/figure_4_6.lua
--     lissom run examples/hair/figure_4_6.lua --fidelity thesis
--     lissom run examples/hair/figure_4_6.lua --head ict_head.obj --count 20000

local hairdo = require "hairdo"
local strokes = require "strokes"

local params = hairdo.params{ name = "figure_4_6", more = { fidelity = hairdo.fidelity } }
local by = strokes.by

local head = hairdo.head(params)
local style = hairdo.style(head, params, { fidelity = params.fidelity })
local route = strokes.route(style)

local streams = {
    { { -38, 44, 10 }, { -12, 49, 20 }, { 22, 45, 22 }, { 52, 33, 20 }, { 72, 8, 20 }, by(4, -50, -4),
      by(-4, -70, -4) },
    { { -30, 70, 12 }, { 30, 72, 18 }, { 66, 48, 20 }, { 84, 15, 22 }, by(6, -50, 0), by(-4, -70, 0) },
    { { -52, 45, 8 }, { -70, 26, 14 }, { -79, 2, 18 }, by(-4, -50, -4), by(4, -70, -4) },
    { { -80, 65, 10 }, { -88, 38, 18 }, { -92, 8, 22 }, by(-6, -50, 0), by(4, -70, 0) },
    { { 120, 72, 12 }, { 106, 42, 20 }, { 108, 5, 22 }, by(6, -60, 2), by(-4, -70, 4) },
    { { -125, 72, 12 }, { -108, 42, 20 }, { -110, 5, 22 }, by(-6, -60, 2), by(4, -70, 4) },
    { { 155, 68, 10 }, { 140, 35, 20 }, { 137, -5, 22 }, { 140, -35, 22 }, by(0, -70, -2) },
    { { -155, 68, 10 }, { -140, 35, 20 }, { -137, -5, 22 }, { -140, -35, 22 }, by(0, -70, -2) },
    { { 175, 62, 8 }, { 172, 25, 20 }, { 172, -15, 22 }, by(0, -60, 6), by(0, -70, 4) },
    { { -165, 80, 12 }, { -168, 55, 18 }, { -170, 15, 22 }, { -170, -20, 22 }, by(0, -90, 8) },
}
for i, places in ipairs(streams) do
    style:add_stream{ points = route(places), name = "stream " .. i }
end

local hair = hairdo.grow(style, params, {
    length = 0.25,
    layer = 0.012,
    cut = { point = style:scalp():from_metres(0, -0.118, 0), ragged = 0.006 },
})
hairdo.finish(style, hair, params)
