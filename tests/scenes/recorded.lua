-- What a hand does with the tools is recorded, and done again without it: the scene has the same hash after
-- each step, and at the end.
local hand = require "hand"
local lissom = require "lissom"

local function bar() return lissom.shapes.bar{ across = 4, along = 20 } end

-- A cup that is open along x.
local function cup(direction, x, radius)
    local ball = lissom.shapes.sphere{ kind = "triangles", segments = 10 }
    local half = ball:cut{ plane = { point = { 0.02 * direction, 0, 0 }, normal = { -direction, 0, 0 } } }
    return half:transform{ scale = radius, translate = { x, 0, 0 } }
end

-- Does it with a recording, and that again in a scene of the same objects.
local function again(tool, objects, act, options)
    options = options or {}
    options.record = true
    local h = hand.new(tool, objects(), options)
    act(h)
    local text = h.host:recording()
    local file = test.file("recording.lua")
    local stream = assert(io.open(file, "w"))
    stream:write(text)
    stream:close()
    local fresh = hand.new("select", objects())
    lissom.replay(file, { scene = fresh.scene })
    expect.equal(fresh.scene:hash(), h.scene:hash())
    expect.equal(fresh:steps(), h:steps())
    expect.truthy(h:steps() > 0)
    -- The journal ends with a check of the hash.
    local told, other = h.host:journal_text(), hand.new("select", objects())
    if os.getenv("LISSOM_SHOW_JOURNAL") then print(told) end
    expect.falsy(told:find("record events instead"))
    assert(load(told, "=journal"))(other.scene)
    expect.equal(other:steps(), h:steps())
end

local function one_bar() return { bar = bar() } end

test("a bar is bent, undone, done again, and bent on by a number", function()
    again("deform", one_bar, function(h)
        h:drag{ { -0.5, -2.4, 0.5 }, { 0.5, -2.4, 0.5 } }
        h:key("p")
        h.host:set{ falloff = 0.2 }
        h:drag{ { -0.5, 2.4, 0.5 }, { 0.5, 2.4, 0.5 } }
        h:key("enter")
        local x, y = table.unpack(h.scene:get("bar deformation"):handles()[2]:center())
        h:drag({ { x + 0.6, y, 0 }, { x + 1.6, y, 0 } }, { ctrl = true })
        h.host:undo()
        h.host:redo()
        h:press{ x + 1.6, y, 0 }
        h:move{ x + 2.6, y, 0 }
        h.host:cancel()
        h:key("e", "z")
        h.host:type("-35.5")
        h:key("enter")
    end)
end)

test("a chain of bones is laid, reaches, is undone, and turns", function()
    again("bones", one_bar, function(h)
        h:drag{ { 0, -0.2, 0.5 }, { 0, 2.3, 0.5 } }
        local tip = h.scene:get("bar deformation"):bones()[1]:joints()[4]
        h:drag({ tip, { 1.2, 1.4, 0 } }, {}, 9)
        h.host:undo()
        h.host:redo()
        local joints = h.scene:get("bar deformation"):bones()[1]:joints()
        h:drag({ joints[3], { joints[3][1] - 0.5, joints[3][2], 0 } }, {}, 9)
        h:key("r")
    end)
end)

test("a part is painted in many strokes, each of which adds to what was there", function()
    again("deform", one_bar, function(h)
        h:drag({ { -0.5, -2.4, 0.5 }, { 0.5, -2, 0.5 }, { -0.5, -1, 0.5 } }, {}, 3)
        h:drag({ { -0.5, 0, 0.5 }, { 0.5, 0.5, 0.5 }, { -0.5, 1, 0.5 } }, { shift = true }, 3)
        h:key("enter")
    end)
end)

test("two cups are merged by two loops and two keys", function()
    again("merge", function() return { small = cup(1, -2, 1), large = cup(-1, 2, 1.5) } end, function(h)
        h:click{ -2, 0.3, math.sqrt(0.91) }
        h:click{ 2, 0, 1.5 }
        h:click{ -2, 0, 1 }
        h:click{ 2, 1.5 * math.sin(0.5), 1.5 * math.cos(0.5) }
        h:click{ -2, math.sin(-1), math.cos(-1) }
        h:click{ 2, 1.5 * math.sin(-0.5), 1.5 * math.cos(-0.5) }
        h.host:set{ transition = 0.4 }
        h:key("enter")
    end, { ortho = 19.2 })
end)

test("selecting, cutting, smoothing and moving, one after the other", function()
    again("select", one_bar, function(h)
        h.host:set{ by = "lasso" }
        h:drag{ { -1, 1, 0 }, { 1, 1, 0 }, { 1, 3, 0 }, { -1, 3, 0 } }
        h:key("+", "+")
        h:use("smooth")
        h:drag{ { -0.4, 2, 0.5 }, { 0.4, 2, 0.5 } }
        h:drag({ { -0.4, 1.5, 0.5 }, { 0.4, 1.5, 0.5 } }, { pressure = 0.3 })       -- by a pen
        h:use("cut")
        h.host:set{ by = "region" }
        h:key("enter")
        h.host:set{ by = "line" }
        h:drag{ { -2, -1, 0 }, { 2, -0.5, 0 } }
        h:use("transform")
        h:click{ 0, 2, 0.5 }
        h:key("w", "y")
        h.host:type("1")
        h:key("enter")
        h.host:undo()
        h:use("measure")
        h:click{ 0, 0, 0.5 }
    end)
end)
