-- Cutting by hand: along a drawn line, a clicked path, the outline of what is selected.
local hand = require "hand"
local lissom = require "lissom"

-- Upright, five units long and one wide.
local function bar() return lissom.shapes.bar{ across = 4, along = 20 } end

local h

test.before(function() h = hand.new("cut", { bar = bar() }) end)

test("a line across a bar makes two of it, in its place; the bar itself is hidden", function()
    local before = h.scene:hash()
    h:press{ -2, 1, 0 }
    h:move{ 2, 1, 0 }
    local drawn = h.host:draw()
    expect.equal(#drawn.outlines, 1)
    expect.equal(#drawn.lines, 1)
    h:release{ 2, 1, 0 }
    expect.equal(h.scene:names(), { "bar", "bar 2", "bar 3" })
    expect.equal(h.scene:info("bar").visible, false)
    local first, second = h.scene:get("bar 2"), h.scene:get("bar 3")
    expect.near(first:area() + second:area(), bar():area(), 1e-9)
    expect.near(math.max(first:bounds().min[2], second:bounds().min[2]), 1, 1e-9)
    expect.equal(#h.host:draw().outlines, 0)
    expect.equal(#h.host:draw().lines, 1)       -- the edge that was cut
    expect.equal(h:steps(), 1)
    expect.equal(h:there_and_back(), before)
end)

test("a part is cut again", function()
    h:drag{ { -2, 1, 0 }, { 2, 1, 0 } }
    h:drag{ { -2, -1, 0 }, { 2, -1, 0 } }
    expect.equal(#h.scene, 5)
    local visible = 0
    for _, name in ipairs(h.scene:names()) do
        if h.scene:info(name).visible then visible = visible + 1 end
    end
    expect.equal(visible, 3)
    h:there_and_back()
end)

test("a slanted line seen in perspective is the plane through the eye", function()
    local eye = { 6, 3, 9 }
    h = hand.new("cut", { bar = bar() }, { eye = eye, fov = 40 })
    h:drag{ { -1, -0.5, 0 }, { 1, 0.7, 0 } }
    local line = h.scene:get("bar 2"):boundaries()[1]
    for _, point in ipairs(line:points()) do
        local x, y = h.camera:project(point)
        local a, b = h:at{ -1, -0.5, 0 }, h:at{ 1, 0.7, 0 }
        expect.near((x - a.x) * (b.y - a.y), (y - a.y) * (b.x - a.x), 1e-3)
    end
end)

test("lines that hit nothing, or are none, are no step", function()
    h:drag{ { 3, 3, 0 }, { 4, 4, 0 } }
    h:click{ 0, 0, 0 }
    expect.equal(h:steps(), 0)
    h:key("enter", "backspace")
    expect.equal(h:steps(), 0)
end)

test("of several places that the plane meets only the drawn one, or all", function()
    local both = bar():append(bar():transform{ translate = { 3, 0, 0 } })
    h = hand.new("cut", { both = both })
    h:drag{ { -1, 0.9, 0 }, { 1, 0.9, 0 } }
    expect.equal(#h.scene:get("both 2"):boundaries(), 1)
    h.host:undo()
    h.host:set{ all = true }
    h:drag{ { -1, 0.9, 0 }, { 1, 0.9, 0 } }
    expect.equal(#h.scene:get("both 2"):boundaries(), 2)
end)

test("a path of clicked points, from all sides", function()
    h = hand.new("cut", { ball = lissom.shapes.sphere{ kind = "triangles", segments = 16 } })
    local before = h.scene:hash()
    h.host:set{ by = "path" }
    h:click{ 3, 3, 0 }
    h:key("enter")
    h:click{ 0.4, 0.5, 0 }
    h:click{ -0.4, 0.5, 0 }
    h:click{ -0.4, 0.5, 0 }            -- again, which counts once
    h:click{ -0.9, -0.9, 0 }
    expect.equal(#h.host:draw().lines, 1)
    h:click{ 0, -0.8, 0 }
    h:click{ 0.2, 0.7, 0 }
    h:key("backspace")
    h:key("enter")
    expect.equal(#h.scene, 3)
    local part = h.scene:get("ball 2")
    expect.equal(#part:boundaries(), 1)
    expect.truthy(part:check().manifold)
    expect.equal(h:steps(), 1)
    expect.equal(h:there_and_back(), before)
    expect.equal(#h.host:draw().lines, 1)
    h.host:undo()
    expect.equal(#h.host:draw().lines, 0)
end)

test("a path begun on an object that goes is forgotten", function()
    h.host:set{ by = "path" }
    h:click{ 0.25, 0.5, 0.5 }
    h:click{ -0.25, 0.5, 0.5 }
    h.scene:remove("bar")
    h:key("enter")
    h.host:draw()
    expect.equal(#h.scene, 0)
    h.host:undo()
    h:click{ 0.25, 0.5, 0.5 }
    h.host:cancel()
    h:key("enter")
    expect.equal(#h.scene, 1)
end)

test("along the outline of what is selected; without a selection it says so", function()
    h.host:set{ by = "region" }
    expect.error(function() h:key("enter") end, "nothing is selected")
    local mesh = h.scene:get("bar")
    mesh:set_region("selected", mesh:region{ box = { min = { nil, 1.2, nil } } })
    h:key("enter")
    expect.equal(#h.scene, 3)
    expect.equal(h:selected("bar 2"), {})
    expect.near(h.scene:get("bar 2"):bounds().max[2], 2.5)
    h:there_and_back()
    h.host:undo()
    mesh:set_region("selected", mesh:region{ all = true })
    local before = h.scene:hash()
    expect.error(function() h:key("enter") end, "invalid_argument")
    expect.equal(h.scene:hash(), before)
end)

test("Escape and another tool in the middle of a line; an object that goes under it", function()
    local before = h.scene:hash()
    h:press{ -2, 1, 0 }
    h:move{ 2, 1, 0 }
    h.host:cancel()
    h:release{ 2, 1, 0 }
    expect.equal(h.scene:hash(), before)
    expect.equal(#h.host:draw().outlines, 0)
    h:press{ -2, 1, 0 }
    h:move{ 2, 1, 0 }
    h.host:use(lissom.load_tool("select"))
    h.host:use(h.tool)
    expect.equal(h.scene:hash(), before)
    h:press{ -2, 1, 0 }
    h:move{ 1, 1, 0 }
    h.scene:remove("bar")
    h:move{ 2, 1, 0 }
    h:release{ 2, 1, 0 }
    expect.equal(#h.scene, 0)
end)

test("an object that stands turned and mirrored is cut where the line is, its parts stand there", function()
    local place = { { 0, 2, 0, 1 }, { 2, 0, 0, 0 }, { 0, 0, 2, 0 }, { 0, 0, 0, 1 } }
    h = hand.new("cut", { bar = bar() }, { places = { bar = place } })
    h:drag{ { 2, -2, 0 }, { 2, 2, 0 } }             -- x = 2 is the bar's y = .5
    local a, b = h.scene:get("bar 2"):bounds(), h.scene:get("bar 3"):bounds()
    expect.near(math.max(a.min[2], b.min[2]), 0.5, 1e-9)
    expect.equal(h.scene:info("bar 3").transform, place)
end)

test("far from the origin, with a hole and 40,000 faces", function()
    local tube = lissom.shapes.cylinder{
        segments = 200, rings = 200, radius = 0.5, height = 5, caps = false,
    }
    local far = 1e5
    tube:transform{ translate = { far, far, far } }
    h = hand.new("cut", { tube = tube }, { eye = { far, far, far + 50 }, target = { far, far, far } })
    h:drag{ { far - 2, far + 1, far }, { far + 2, far + 1, far } }
    local first, second = h.scene:get("tube 2"), h.scene:get("tube 3")
    expect.equal(#first:boundaries(), 2)
    expect.equal(#second:boundaries(), 2)
    expect.near(math.max(first:bounds().min[2], second:bounds().min[2]), far + 1, 1e-6)
end)

-- Drags over points of a bow across the bar, from beside it to beside it.
local function bow(x)
    local list = {}
    for i = 0, 12 do
        local t = i / 12
        list[i + 1] = { x * (2 * t - 1), 1 + 0.6 * math.sin(math.pi * t), 0 }
    end
    return list
end

test("by draw: a line of any form across the bar cuts it through, as it was drawn", function()
    local fine = lissom.shapes.bar{ across = 16, along = 80 }
    h = hand.new("cut", { bar = fine })
    local before = h.scene:hash()
    h.host:set{ by = "draw" }
    h:drag(bow(1.2))
    expect.equal(h.scene:names(), { "bar", "bar 2", "bar 3" })
    local first, second = h.scene:get("bar 2"), h.scene:get("bar 3")
    expect.near(first:area() + second:area(), fine:area(), 1e-6)
    local line = first:boundaries()
    expect.equal(#line, 1)
    local low, high = math.huge, -math.huge
    for _, p in ipairs(line[1]:points()) do low, high = math.min(low, p[2]), math.max(high, p[2]) end
    expect.near({ low, high }, { 1.476, 1.6 }, 0.05)
    expect.equal(h:steps(), 1)
    expect.equal(h:there_and_back(), before)
end)

test("by draw: round on the surface; lines that end on it say what to do", function()
    local ball = lissom.shapes.sphere{ kind = "triangles", segments = 24 }
    h = hand.new("cut", { ball = ball }, { ortho = 3 })
    h.host:set{ by = "draw" }
    local ring, steps = {}, h:steps()
    for i = 0, 24 do
        local turn = 2 * math.pi * i / 24
        ring[i + 1] = { 0.5 * math.cos(turn), 0.5 * math.sin(turn), 0 }
    end
    h:drag(ring)
    expect.equal(h:steps(), steps + 1)
    local areas = { h.scene:get("ball 2"):area(), h.scene:get("ball 3"):area() }
    -- A cap of the unit ball: 2 pi (1 - cos 30).
    expect.near(math.min(areas[1], areas[2]), 2 * math.pi * (1 - math.sqrt(0.75)), 0.05)
    h.host:undo()
    local before = h.scene:hash()
    expect.error(function() h:drag{ { -0.3, 0, 0 }, { 0, 0.1, 0 }, { 2, 0, 0 } } end, "from beside the mesh")
    expect.error(function() h:drag{ { 2, 2, 0 }, { 2, 2.5, 0 }, { 3, 2, 0 } } end, "draw over a mesh")
    h:drag{ { 0, 0, 0 }, { 0, 0, 0 } }
    expect.equal(h.scene:hash(), before)
end)
