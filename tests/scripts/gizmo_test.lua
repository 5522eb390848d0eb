local lissom = require "lissom"

local size = { 640, 480 }
local camera = lissom.camera{ eye = { 0, 0, 5 }, ortho = 4.8 }      -- a pixel is a hundredth

test("what is under the cursor, and what to draw there", function()
    local gizmo = lissom.gizmo{ origin = { 0.5, 0, 0 }, size = 100 }
    expect.equal(gizmo:hit(camera, size, 370 + 120, 240), "move-x")
    expect.equal(gizmo:hit(camera, size, 370 + 65, 240), "scale-x")
    expect.equal(gizmo:hit(camera, size, 370, 240), "move-view")
    expect.equal(gizmo:hit(camera, size, 10, 10), nil)
    local shape = gizmo:shape(camera, size, { x = 370 + 120, y = 240 })
    expect.equal(shape.part, "move-x")
    for _, line in ipairs(shape.lines) do
        expect.equal(line.highlighted, line.part == "move-x")
        expect.equal(#line.color, 3)
    end
    expect.equal(gizmo:shape(camera, size).part, nil)
    local behind = lissom.camera{ eye = { 0, 0, -1 }, target = { 0, 0, -2 } }
    expect.equal(#gizmo:shape(behind, size).lines, 0)
end)

test("a drag gives the motion since the press, and the gizmo goes along", function()
    local gizmo = lissom.gizmo{ origin = { 0.5, 0, 0 }, size = 100 }
    gizmo:begin("move-x", camera, size, 470, 240)
    local motion = gizmo:drag(500, 300)
    expect.equal(motion.kind, "move")
    expect.equal(motion.part, "move-x")
    expect.near(motion.translation, { 0.3, 0, 0 })
    expect.near(motion.amounts, { 0.3 })
    expect.near(motion.matrix[1][4], 0.3)
    expect.near(gizmo:origin()[1], 0.8)
    expect.equal(gizmo:shape(camera, size).part, "move-x")
    expect.near(gizmo:drag(500, 300, { precise = true }).translation[1], 0.3)
    expect.near(gizmo:drag(600, 300, { precise = true }).translation[1], 0.4)
    expect.near(gizmo:cancel():origin()[1], 0.5)
    expect.equal(gizmo:part(), nil)
end)

test("turns are in degrees and count full turns; snapping takes steps", function()
    local gizmo = lissom.gizmo{ mode = "rotate", steps = { angle = 10 } }
    gizmo:begin("rotate-z", camera, size, 420, 240)
    local motion
    for degrees = 10, 400, 10 do
        local angle = math.rad(degrees)
        motion = gizmo:drag(320 + 100 * math.cos(angle), 240 - 100 * math.sin(angle))
    end
    expect.near(motion.angle, 400)
    expect.near(motion.axis, { 0, 0, 1 })
    expect.near(gizmo:drag(420, 237, { snap = true }).angle, 360)
    expect.near(gizmo:set_amount(45).angle, 45)
    expect.near(gizmo:motion().matrix[1], { math.sqrt(0.5), -math.sqrt(0.5), 0, 0 })
    expect.near(gizmo:finish().angle, 45)
    expect.equal(gizmo:motion(), nil)
end)

test("what the parts of a motion do to a mesh is what its matrix says", function()
    local gizmo = lissom.gizmo{ origin = { 0.2, 0.1, 0 } }
    for part, amount in pairs{ ["scale-y"] = 2, ["rotate-x"] = 50, ["move-zx"] = 0.7, ["scale-all"] = 0.5 } do
        gizmo:begin(part, camera, size, 400, 200):set_amount(amount)
        local motion = gizmo:motion()
        gizmo:cancel()
        local box = lissom.shapes.box()
        local changed = box:copy():transform{
            translate = motion.translation,
            rotate = motion.axis and { axis = motion.axis, angle = motion.angle, about = motion.about },
            scale = motion.factors,
            about = motion.about,
        }
        local m = motion.matrix
        for v = 1, #box do
            local x, y, z = box:position(v)
            local p = {}
            for i = 1, 3 do p[i] = m[i][1] * x + m[i][2] * y + m[i][3] * z + m[i][4] end
            expect.near({ changed:position(v) }, p)
        end
    end
end)

test("in a plane two numbers are typed", function()
    local gizmo = lissom.gizmo{}
    gizmo:begin("move-view", camera, size, 320, 240)
    expect.near(gizmo:set_amount(1, -2).translation, { 1, -2, 0 })
    expect.near(gizmo:motion().amounts, { 1, -2 })
    gizmo:finish()
    expect.near(gizmo:origin(), { 1, -2, 0 })
end)

test("axes are those of the world, of the object or of the view", function()
    local turned = { { 0, -1, 0 }, { 1, 0, 0 }, { 0, 0, 1 } }
    local gizmo = lissom.gizmo{ axes = "local", local_axes = turned }
    expect.near((gizmo:axes(camera)), { 0, 1, 0 })
    gizmo:begin("rotate-z", camera, size, 400, 240):set_amount(90)
    gizmo:finish()
    expect.near((gizmo:axes(camera)), { -1, 0, 0 })
    local side = lissom.camera{ eye = { 5, 0, 0 } }
    expect.near((gizmo:set{ axes = "view" }:axes(side)), { 0, 0, -1 })
    expect.near((gizmo:set{ axes = "world" }:axes(side)), { 1, 0, 0 })
end)

test("a gizmo that is held is not changed, and one that is not is not dragged", function()
    local gizmo = lissom.gizmo{}
    expect.error(function() gizmo:drag(1, 2) end, "begin a drag first")
    expect.error(function() gizmo:begin("move-w", camera, size, 1, 2) end, "move-x")
    gizmo:begin("scale-all", camera, size, 320, 240)
    expect.error(function() gizmo:set{ size = 50 } end, "finish or cancel")
    expect.error(function() gizmo:set_amount(0) end, "factor of 0")
    local scaled = { { 2, 0, 0 }, { 0, 2, 0 }, { 0, 0, 2 } }
    expect.error(function() lissom.gizmo{ local_axes = scaled } end, "orthogonal")
end)
