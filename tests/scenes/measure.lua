-- Measuring by hand.
local hand = require "hand"
local lissom = require "lissom"

local h

test.before(function() h = hand.new("measure", { box = lissom.shapes.box() }) end)

local function label() return (h.host:draw().labels[1] or {}).text end

test("the distance of two points; a third click begins anew", function()
    h:click{ -0.5, -0.5, 0.5 }
    expect.equal(label(), nil)
    h:click{ 0.5, 0.5, 0.5 }
    expect.equal(label(), "1.414")
    expect.equal(#h.host:draw().lines, 1)
    h:click{ 0, 0, 0.5 }
    expect.equal(label(), nil)
    h:click{ 0.25, 0, 0.5 }
    expect.equal(label(), "0.25")
    h:key("backspace")
    expect.equal(label(), nil)
    h:click{ 0.5, 0, 0.5 }
    expect.equal(label(), "0.5")
    h:key("d")
    expect.equal(label(), nil)
    expect.equal(h:steps(), 0)
end)

test("an angle, at the second point", function()
    h.host:set{ what = "angle" }
    h:click{ 0.25, 0, 0.5 }
    h:click{ 0, 0, 0.5 }
    h:click{ 0, 0.25, 0.5 }
    expect.equal(label(), "90 degrees")
    h:click{ 0.25, 0, 0.5 }
    h:click{ 0, 0, 0.5 }
    h:click{ -0.25, 0, 0.5 }
    expect.equal(label(), "180 degrees")
    h:click{ 0.25, 0, 0.5 }
    h:click{ 0.25, 0, 0.5 }
    h:click{ 0, 0, 0.5 }
    expect.equal(label(), "no angle")
end)

test("the way over the surface of a ball", function()
    h = hand.new("measure", { ball = lissom.shapes.sphere{ kind = "triangles", segments = 24 } })
    h.host:set{ what = "surface" }
    h:click{ -0.6, 0, 0.8 }
    h:click{ 0.6, 0, 0.8 }
    expect.near(tonumber(label():match("^[%d.]+")), 2 * math.asin(0.6), 0.04)
    expect.truthy(#h.host:draw().lines[1].points > 3)
    expect.equal(h:steps(), 0)
end)

test("the way between two points of one face is straight, and that to the same point nothing", function()
    h.host:set{ what = "surface" }
    h:click{ 0.2, 0.2, 0.5 }
    h:click{ -0.2, -0.1, 0.5 }
    expect.equal(label(), "0.5 over the surface")
    h:click{ 0.2, 0.2, 0.5 }
    h:click{ 0.2, 0.2, 0.5 }
    expect.equal(label(), "0 over the surface")
end)

test("points at one vertex, on different faces", function()
    h = hand.new("measure", { ball = lissom.shapes.sphere{ kind = "triangles", segments = 8 } })
    h.host:set{ what = "surface" }
    local ball = h.scene:get("ball")
    local vertex = ball:nearest(0, 0, 1).vertex
    local x, y, z = ball:position(vertex)
    h:click{ x + 0.02, y + 0.01, z }
    h:click{ x - 0.03, y + 0.02, z }
    expect.truthy(tonumber(label():match("^[%d.e-]+")) < 0.2)
end)

test("no way from one part to another", function()
    local two = lissom.shapes.sphere{ kind = "triangles", segments = 8 }
    two:append(two:copy():transform{ translate = { 3, 0, 0 } })
    h = hand.new("measure", { two = two, other = lissom.shapes.box():transform{ translate = { -3, 0, 0 } } })
    h.host:set{ what = "surface" }
    h:click{ 0, 0, 1 }
    h:click{ 3, 0, 1 }
    expect.equal(label(), "two parts")
    h:click{ 0, 0, 1 }
    h:click{ -3, 0, 0.5 }
    expect.equal(label(), "two objects")
end)

test("area and volume, as the object stands in the world", function()
    local place = { { 0, 2, 0, 0 }, { 1, 0, 0, 0 }, { 0, 0, 3, 0 }, { 0, 0, 0, 1 } }       -- mirrored
    h = hand.new("measure", { box = lissom.shapes.box() }, { places = { box = place } })
    h.host:set{ what = "object" }
    h:click{ 0.2, 0.1, 1.5 }
    expect.equal(label(), "box: area 22, volume 6")
    h.scene:set("box", { transform = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } } })
    expect.equal(label(), "box: area 6, volume 1")
    h = hand.new("measure", { tube = lissom.shapes.cylinder{ caps = false } })
    h.host:set{ what = "object" }
    h:click{ 0, 0, 1 }
    expect.truthy(label():find("(open)", 1, true))
end)

test("points stay on the surface when it moves, also by undo", function()
    h:click{ -0.5, 0, 0.5 }
    h:click{ 0.5, 0, 0.5 }
    expect.equal(label(), "1")
    h.scene:step("stretch", function() h.scene:get("box"):transform{ scale = { 2, 1, 1 } } end)
    expect.equal(label(), "2")
    h.host:undo()
    expect.equal(label(), "1")
end)

test("an object that goes takes its points along; the void and Escape do no harm", function()
    h:click{ 3, 3, 0 }
    h:click{ -0.5, 0, 0.5 }
    h:click{ 0.5, 0, 0.5 }
    h.scene:remove("box")
    expect.equal(label(), nil)
    h:click{ 0, 0, 0.5 }
    h.host:undo()
    expect.equal(label(), "1")
    h:press{ 0, 0, 0.5 }
    h.host:cancel()
    h.host:use(lissom.load_tool("select"))
    h.host:use(h.tool)
    expect.equal(label(), nil)
end)

test("far from the origin, with 40,000 faces", function()
    local ball = lissom.shapes.sphere{ kind = "triangles", segments = 46 }
        :transform{ translate = { 1e5, 1e5, 1e5 } }
    h = hand.new("measure", { ball = ball },
        { eye = { 1e5, 1e5, 1e5 + 9 }, target = { 1e5, 1e5, 1e5 }, fov = 30 })
    h:click{ 1e5 - 0.6, 1e5, 1e5 + 0.8 }
    h:click{ 1e5 + 0.6, 1e5, 1e5 + 0.8 }
    expect.near(tonumber(label()), 1.2, 0.02)
    h.host:set{ what = "surface" }
    h:click{ 1e5 - 0.6, 1e5, 1e5 + 0.8 }
    h:click{ 1e5 + 0.6, 1e5, 1e5 + 0.8 }
    expect.near(tonumber(label():match("^[%d.]+")), 2 * math.asin(0.6), 0.03)
end)
