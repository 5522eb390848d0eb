-- Effect of the scalp step (section 4.6 of the thesis): hair that follows the field alone grows into the head
-- if the field points there; avoid_scalp turns the field along the head. Both are grown without `avoid`,
-- which would keep strands outside as they grow, so that only the field counts. Pictures show the hair, and
-- the curves with the field on a plane through the head.
--
--     lissom run examples/hair/avoid_scalp.lua
--     lissom run examples/hair/avoid_scalp.lua --head ict_head.obj --count 50000

local hairdo = require "hairdo"
local lissom = require "lissom"
local strokes = require "strokes"

local params = hairdo.params{ name = "avoid_scalp", count = 20000 }
local by = strokes.by

local head = hairdo.head(params)
local style = hairdo.style(head, params)
local route = strokes.route(style)

-- A few curves that leave much open between them.
strokes.both_sides({
    { { 20, 46, 14 }, { 52, 34, 18 }, { 78, 8, 18 }, by(4, -50, -4) },
    { { 150, 70, 12 }, { 150, 35, 20 }, { 150, -5, 22 }, by(0, -50, 0) },
}, function(places) style:add_stream{ points = route(places) } end)

-- Hair that keeps out of the head by the field alone, and its strands that are more than a millimetre inside.
local function grown(what)
    local hair = style:grow{ count = params.count, length = 0.2, avoid = false }
    local stats = hair:stats{ style = style, depth = 0.001 }
    local share = 100 * stats.penetrating / math.max(1, #hair)
    print(string.format("%s: %.1f %% of %d strands run through the head, %d grid points are constrained",
        what, share, #hair, style:stats().constraints))
    return hair, share
end

local function draw_field(file)
    if not params.pictures then return end
    print(lissom.render{
        style = style, style_marks = { field = true, normal = style:scalp():left() }, view = "left",
        size = { params.size, params.size }, file = params.out .. "/" .. params.name .. "_" .. file .. ".png",
    })
end

local before, share_before = grown("without the step")
draw_field("field")
style:avoid_scalp()
local after, share_after = grown("with it")
draw_field("turned")

assert(share_after < 0.5 * share_before or share_before < 0.5, "the scalp step keeps too little hair out")
style:save(params.out .. "/" .. params.name .. ".json")
if params.pictures then
    print(lissom.render{
        meshes = { head, head }, strands = { before, after }, columns = 2,
        captions = { string.format("%.1f %% in the head", share_before),
            string.format("%.1f %%", share_after) },
        camera = hairdo.camera(style, before, "left"), background = "#c8ccd2",
        size = { 2 * params.size, params.size }, file = params.out .. "/" .. params.name .. ".png",
    })
end
