-- Smoothing by hand.
local hand = require "hand"
local lissom = require "lissom"

-- A sheet of 41 x 41 vertices that looks at the camera, with a bump in every second one.
local function rough(x)
    local sheet = lissom.shapes.grid{ size = { 4, 4 }, segments = { 40, 40 } }
        :transform{ rotate = { axis = "x", angle = 90 }, translate = { x or 0, 0, 0 } }
    local positions = sheet:positions()
    for v = 2, #sheet, 2 do positions[3 * v] = positions[3 * v] + 0.1 end
    return sheet
end

-- How rough a sheet is near a point: the greatest height above the lowest.
local function height(mesh, x, y, radius)
    local box = mesh:region{ sphere = { center = { x, y, 0 }, radius = radius } }:bounds()
    return box.max[3] - box.min[3]
end

local h, mesh

test.before(function()
    mesh = rough()
    h = hand.new("smooth", { sheet = mesh })
end)

test("a stroke smooths what it comes over, in one step", function()
    local before = h.scene:hash()
    h:drag({ { -1, 0, 0 }, { 1, 0, 0 } }, nil, 8)
    expect.truthy(height(mesh, 0, 0, 0.15) < 0.03)
    expect.near(height(mesh, 0, 1.5, 0.3), 0.1)
    expect.equal(h:steps(), 1)
    expect.equal(h:there_and_back(), before)
end)

test("strength, steps and size of the brush", function()
    h.host:set{ strength = 0.01, iterations = 1 }
    h:click{ 0, 0, 0 }
    local little = height(mesh, 0, 0, 0.15)
    h.host:undo()
    h.host:set{ strength = 0.6, iterations = 5, radius = 100 }
    h:click{ 0, 0, 0 }
    expect.truthy(height(mesh, 0, 0, 0.15) < little / 2)
    expect.truthy(height(mesh, 0.8, 0, 0.15) < 0.05)
    expect.equal(#h.host:draw().circles, 1)
end)

test("a pen smooths as hard, or as widely, as it presses", function()
    local function pressed(parameter, pressure)
        h.host:set{ pressure = parameter, radius = 100 }
        h:click({ 0, 0, 0 }, { pressure = pressure })
        local middle, rim = height(mesh, 0, 0, 0.15), height(mesh, 0.6, 0, 0.15)
        h.host:undo()
        return middle, rim
    end
    local full, full_rim = pressed("none", 0.2)
    expect.near(full, (pressed("strength", 1)))
    expect.truthy(pressed("strength", 0.2) > 2 * full)
    local narrow, narrow_rim = pressed("radius", 0.2)
    expect.near(narrow, full, 0.01)
    expect.truthy(full_rim < 0.05)
    expect.near(narrow_rim, 0.1)
    expect.error(function() h:click({ 0, 0, 0 }, { pressure = 2 }) end, "pressure")
end)

test("only what is selected, where anything is", function()
    mesh:set_region("selected", mesh:region{ box = { max = { 0, nil, nil } } })
    h:drag({ { -1, 0, 0 }, { 1, 0, 0 } }, nil, 8)
    expect.truthy(height(mesh, -0.6, 0, 0.15) < 0.03)
    expect.near(height(mesh, 0.6, 0, 0.15), 0.1)
end)

test("beside the surface nothing happens", function()
    h:drag{ { 3, 3, 0 }, { 4, 4, 0 } }
    expect.equal(h:steps(), 0)
end)

test("Escape, undo and another tool in the middle of a stroke", function()
    local before = h.scene:hash()
    for _, interrupt in ipairs{
        function() h.host:cancel() end,
        function() h.host:undo() end,
        function()
            h.host:use(lissom.load_tool("select"))
            h.host:use(h.tool)
        end,
    } do
        h:press{ -1, 0, 0 }
        h:move{ 0, 0, 0 }
        expect.truthy(h.scene:hash() ~= before)
        interrupt()
        h:release{ 1, 0, 0 }
        while h:steps() > 0 do h.host:undo() end
        expect.equal(h.scene:hash(), before)
    end
    h:click{ 1, 1, 0 }
    expect.near(height(mesh, 0, 0, 0.15), 0.1)      -- the stroke before is not gone on with
end)

test("the object goes in the middle of a stroke", function()
    h:press{ -1, 0, 0 }
    h.scene:remove("sheet")
    h:move{ 0, 0, 0 }
    h:release{ 1, 0, 0 }
    h.host:draw()
end)

test("a deformation in progress ends with its shape, and undo brings it back", function()
    local deformer = lissom.deformer(mesh)
    deformer:add_handle(mesh:region{ box = { max = { -1.5, nil, nil } } })
    deformer:add_handle(mesh:region{ box = { min = { 1.5, nil, nil } } }):translate(0, 0.5, 0)
    deformer:solve()
    h.scene:add("sheet deformation", deformer, { visible = false })
    local bent = h.scene:hash()
    h:click{ 0, 0.25, 0 }
    expect.equal(#h.scene, 1)
    expect.truthy(mesh:bounds().max[2] > 2.4)
    h.host:undo()
    expect.equal(h.scene:hash(), bent)
end)

test("a deformation that a script has added without its mesh becomes the mesh", function()
    local deformer = lissom.deformer(mesh)
    deformer:add_handle(mesh:region{ box = { max = { -1.5, nil, nil } } })
    h = hand.new("smooth", { sheet = deformer })
    h:click{ 0, 0, 0 }
    expect.equal(h.scene:info("sheet").kind, "mesh")
    expect.truthy(height(mesh, 0, 0, 0.15) < 0.1)
    h.host:undo()
    expect.equal(h.scene:info("sheet").kind, "deformation")
end)

test("two meshes under one brush, a turned one among them, and one with a hole", function()
    local turned = { { 0, -1, 0, 2.2 }, { 1, 0, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } }
    local holed = rough()
    holed = holed:remove(holed:region{ sphere = { center = { 0, 1, 0 }, radius = 0.5 } })
    h = hand.new("smooth", { left = rough(-2.2), right = holed }, { places = { right = turned } })
    local rim = holed:boundaries()[2]:length()
    h:drag({ { -1, 0, 0 }, { 1.5, 0, 0 } }, nil, 8)
    expect.truthy(height(h.scene:get("left"), -0.6, 0, 0.15) < 0.03)
    expect.truthy(height(holed, 0, 1.75, 0.12) < 0.05)
    expect.near(height(holed, 1, 1.75, 0.15), 0.1)
    expect.near(holed:boundaries()[2]:length(), rim)            -- open boundaries stay
end)

test("far from the origin, with 40,000 faces", function()
    local ball = lissom.shapes.sphere{ kind = "triangles", segments = 46 }
        :transform{ translate = { 1e5, 1e5, 1e5 } }
    h = hand.new("smooth", { ball = ball },
        { eye = { 1e5, 1e5, 1e5 + 9 }, target = { 1e5, 1e5, 1e5 }, fov = 30 })
    h:drag{ { 1e5 - 0.2, 1e5, 1e5 + 0.98 }, { 1e5 + 0.2, 1e5, 1e5 + 0.98 } }
    expect.equal(h:steps(), 1)
    expect.near(ball:bounds().max[3], 1e5 + 1, 0.01)
end)
