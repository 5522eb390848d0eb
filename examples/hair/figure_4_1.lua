-- Long hair, half of it up (Figure 4.1): eleven stream curves, four dividing curves and one ponytail. The
-- upper half is gathered in the tie by six streams more; to the letter of the thesis, by its ring alone.
--
--     lissom run examples/hair/figure_4_1.lua
--     lissom run examples/hair/figure_4_1.lua --fidelity thesis
--     lissom run examples/hair/figure_4_1.lua --head ict_head.obj --count 20000

local hairdo = require "hairdo"
local strokes = require "strokes"

local params = hairdo.params{ name = "figure_4_1", more = { fidelity = hairdo.fidelity } }
local to = strokes.to
local literal = params.fidelity == "thesis"

local head = hairdo.head(params)
local style = hairdo.style(head, params, { fidelity = params.fidelity,
    volume = { min = { -0.2, -0.42, -0.24 }, max = { 0.2, 0.2, 0.16 } } })
local route = strokes.route(style)

-- Below the ties hair falls behind the shoulders.
strokes.both_sides({
    { { 20, 37, 4 }, { 46, 28, 14 }, { 66, 6, 18 }, to(86, -60, 22), to(80, -115, -20), to(76, -170, -80),
      to(72, -220, -106), to(70, -360, -110) },
    { { 84, 22, 10 }, { 92, 4, 20 }, to(92, -60, -18), to(76, -120, -58), to(66, -190, -104),
      to(62, -360, -112) },
    { { 124, 20, 8 }, { 122, -5, 20 }, to(70, -80, -66), to(54, -130, -84), to(46, -190, -108),
      to(44, -360, -114) },
    { { 156, 2, 8 }, { 154, -28, 18 }, to(34, -130, -88), to(30, -200, -108), to(28, -360, -114) },
}, function(places) style:add_stream{ points = route(places) } end)
style:add_stream{ points = route{ { 180, -4, 10 }, { 180, -30, 18 }, to(0, -130, -92), to(0, -200, -110),
    to(0, -360, -116) } }

-- Above, it is drawn to the tie: the streams lead into it and do not stop.
strokes.both_sides({ { { 20, 54, 5 }, { 66, 58, 7 }, { 122, 48, 8 }, { 166, 35, 14 } } },
    function(places) style:add_stream{ points = route(places), stop = false } end)

style:add_dividing{ points = route{ { 0, 36 }, { 0, 52 }, { 0, 66 } }, tilt = { 25, 60 }, name = "middle" }
for _, side in ipairs{ 1, -1 } do
    local places = { { 44, 34 }, { 62, 33 }, { 88, 34 }, { 116, 28 }, { 138, 21 } }
    if side < 0 then places = strokes.mirrored(places) end
    -- Seen along the curve from outside, the hair above it is at the left on the head's left side.
    local above, below = { 80, 50 }, { 15, 10 }
    style:add_dividing{ points = route(places), left = side > 0 and above or below,
        right = side > 0 and below or above, height = 0, gap = 0,
        name = side > 0 and "left side" or "right side" }
end
style:add_dividing(route{ { 142, 20 }, { 180, 15 }, { -142, 20 } }, { height = 0, gap = 0, name = "back" })

local tail = { azimuth = 180, elevation = 26, lift = 0.02, length = 0.27, droop = 0.012, radius = 0.018 }
style:add_ponytail{
    spine = hairdo.tail_spine(style:scalp(), tail),
    radius = tail.radius,
    tightness = literal and 0.6 or 1,
    tail_length = tail.length,
    name = "tail",
}
if not literal then
    strokes.both_sides({
        { { 35, 60, 6 }, { 120, 66, 8 }, { 172, 36, 14 } },
        { { 75, 44, 6 }, { 130, 44, 8 }, { 168, 30, 14 } },
        { { 115, 35, 6 }, { 148, 32, 8 }, { 170, 27, 14 } },
    }, function(places) style:add_stream{ points = route(places), stop = false } end)
end

local hair = hairdo.grow(style, params, {
    length = 0.46,
    cut = { point = style:scalp():from_metres(0, -0.36, 0), ragged = 0.012 },
})
hairdo.finish(style, hair, params, { hairdo.ring(style:scalp(), tail) })
