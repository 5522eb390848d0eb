-- Moving, turning and scaling objects by hand.
local hand = require "hand"
local lissom = require "lissom"

local h

test.before(function() h = hand.new("transform", { box = lissom.shapes.box() }) end)

local function place(name) return h.scene:info(name or "box").transform end

test("the gizmo moves the object and not its coordinates", function()
    local before, mesh = h.scene:hash(), h.scene:get("box"):hash()
    h:drag{ { 0.6, 0, 0 }, { 1.6, 0, 0 } }
    expect.near(place()[1][4], 1, 1e-9)
    expect.equal(h.scene:get("box"):hash(), mesh)
    expect.equal(h:steps(), 1)
    h:drag{ { 1, 0.6, 0 }, { 1, 0.1, 0 } }
    expect.near(place()[2][4], -0.5, 1e-9)
    expect.equal(h:there_and_back(), before)
end)

test("turns about its own middle, with ctrl in steps", function()
    h.scene:get("box"):transform{ translate = { 1, 0, 0 } }
    h:key("e", "z")
    h.host:type("90")
    h:key("enter")
    expect.near(place()[1], { 0, -1, 0, 1 }, 1e-9)
    expect.near(place()[2], { 1, 0, 0, -1 }, 1e-9)
    h:key("w")
    h:drag({ { 1.6, 0, 0 }, { 2.04, 0, 0 } }, { ctrl = true })
    expect.near(place()[1][4] * 10 % 1, 0, 1e-6)
    h:there_and_back()
end)

test("scales; a factor of zero is refused, and all stays as it was", function()
    h:key("r")
    h.host:type("2")
    h:key("enter")
    expect.near(place()[3][3], 2, 1e-9)
    local before = h.scene:hash()
    h.host:type("0")
    expect.error(function() h:key("enter") end, "0")
    expect.equal(h.scene:hash(), before)
    h.host:type("3")
    h:key("enter")
    expect.truthy(place()[3][3] >= 3 - 1e-9)
end)

test("a number replaces the drag before it; h puts the object back", function()
    h:drag{ { 0.6, 0, 0 }, { 1.6, 0, 0 } }
    h.host:type("2.25")
    h:key("enter")
    expect.near(place()[1][4], 2.25, 1e-9)
    h.host:type("-1")
    h:key("enter")
    expect.near(place()[1][4], -1, 1e-9)
    h:key("h")
    expect.near(place()[1][4], 0)
    h.host:type("1")
    h:key("enter")
    expect.near(place()[1][4], 1, 1e-9)
    h:there_and_back()
end)

test("along its own axes", function()
    h:key("e", "z")
    h.host:type("45")
    h:key("enter")
    h.host:set{ axes = "local" }
    h:key("w", "x")
    h.host:type("1")
    h:key("enter")
    expect.near({ place()[1][4], place()[2][4] }, { math.sqrt(0.5), math.sqrt(0.5) }, 1e-9)
end)

test("of two objects the one that is clicked, or the next one by tab; the void changes nothing", function()
    h = hand.new("transform", { left = lissom.shapes.box(), right = lissom.shapes.box() },
        { places = { right = { { 1, 0, 0, 3 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } } } })
    h:drag{ { -3, 3, 0 }, { -4, 4, 0 } }
    h:key("x", "tab", "h", "enter")
    expect.equal(h:steps(), 0)
    h:click{ 3, 0, 0 }
    h:drag{ { 3.6, 0, 0 }, { 2.6, 0, 0 } }
    expect.near(place("right")[1][4], 2, 1e-9)
    expect.equal(h.host:draw().labels[1].text, "right")
    h:key("tab")
    h:drag{ { 0.6, 0, 0 }, { 0.1, 0, 0 } }
    expect.near(place("left")[1][4], -0.5, 1e-9)
    h:there_and_back()
end)

test("Escape, undo, another tool in the middle of a drag", function()
    local before = h.scene:hash()
    for _, interrupt in ipairs{
        function() h.host:cancel() end,
        function() h.host:undo() end,
        function()
            h.host:use(lissom.load_tool("select"))
            h.host:use(h.tool)
        end,
    } do
        h:press{ 0.6, 0, 0 }
        h:move{ 1.6, 0, 0 }
        expect.truthy(h.scene:hash() ~= before)
        interrupt()
        h:release{ 1.6, 0, 0 }
        while h:steps() > 0 do h.host:undo() end
        expect.equal(h.scene:hash(), before)
    end
    h:drag{ { 0.6, 0, 0 }, { 1.1, 0, 0 } }
    expect.near(place()[1][4], 0.5, 1e-9)
end)

test("the object goes in the middle of a drag", function()
    h:press{ 0.6, 0, 0 }
    h.scene:remove("box")
    h:move{ 1.6, 0, 0 }
    h:release{ 1.6, 0, 0 }
    h:key("tab", "h", "1", "enter")
    h.host:draw()
    h.host:undo()
    h:drag{ { 0.6, 0, 0 }, { 1.1, 0, 0 } }
    expect.near(place()[1][4], 0.5, 1e-9)
end)

test("a deformation without its mesh is moved as a whole", function()
    local box = lissom.shapes.box{ segments = { 2, 2, 2 } }
    h = hand.new("transform", { bend = lissom.deformer(box), other = lissom.shapes.box() },
        { places = { other = { { 1, 0, 0, 3 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } } } })
    h:click{ 0, 0, 0.5 }
    h:drag{ { 0.6, 0, 0 }, { 1.1, 0, 0 } }
    expect.near(place("bend")[1][4], 0.5, 1e-9)
end)

test("what is bent or painted stays where it is on the object", function()
    h:drag{ { 0.6, 0, 0 }, { 1.6, 0, 0 } }
    h.host:use(lissom.load_tool("select"))
    h.host:set{ by = "component" }
    h:click{ 1, 0, 0.5 }
    expect.equal(#h:selected("box"), 8)
end)

test("far from the origin", function()
    local ball = lissom.shapes.sphere{ kind = "triangles", segments = 46 }
        :transform{ translate = { 1e5, 1e5, 1e5 } }
    h = hand.new("transform", { ball = ball }, { eye = { 1e5, 1e5, 1e5 + 50 }, target = { 1e5, 1e5, 1e5 } })
    h:drag{ { 1e5 + 0.6, 1e5, 1e5 }, { 1e5 + 1.6, 1e5, 1e5 } }
    expect.near(place("ball")[1][4], 1, 1e-6)
    expect.equal(#h.host:draw().labels, 0)
    h:press{ 1e5 + 1.6, 1e5, 1e5 }              -- where the gizmo has gone to
    h:move{ 1e5 + 1.1, 1e5, 1e5 }
    h:release{ 1e5 + 1.1, 1e5, 1e5 }
    expect.near(place("ball")[1][4], 0.5, 1e-6)
end)
