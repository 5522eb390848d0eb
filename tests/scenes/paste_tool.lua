-- Pasting by hand: a part is dragged over a mesh, turned, scaled and let go, and what may come in between.
local hand = require "hand"
local lissom = require "lissom"

-- A ball with a horn towards the eye, at x, whose surroundings are marked.
local function horned(x)
    local mesh = lissom.shapes.sphere{ segments = 20, kind = "triangles" }
    for i = 1, #mesh do
        local px, py, pz = mesh:position(i)
        if pz > 0 then mesh:set_position(i, px, py, pz + 0.8 * math.exp(-14 * (px * px + py * py))) end
    end
    mesh:set_region("region", mesh:region{ sphere = { center = { 0, 0, 1.2 }, radius = 0.85 } })
    return mesh:transform{ translate = { x, 0, 0 } }
end

local function egg() return lissom.shapes.sphere{ segments = 20, kind = "triangles", radius = 1.6 } end

local h

local function objects() return { horn = horned(-3), target = egg():transform{ translate = { 2, 0, 0 } } } end

local function new(options)
    h = hand.new("paste", objects(), options or { ortho = 9.6 })
    h.host:set{ scale = 0.7 }
end

test.before(function() new() end)

test("a part is dragged from its mesh onto another, in one step", function()
    local before = h.scene:hash()
    h:press{ -3, 0, 1.5 }
    h:move{ -1, 0, 0 }
    expect.equal(#h.host:draw().lines, 0)
    h:move{ 1.8, 0.2, 1.5 }
    h:move{ 2.2, 0.3, 1.5 }
    local shown = h.host:draw()
    expect.equal(#shown.lines, 1)
    expect.truthy(shown.labels[1].text:find("energy", 1, true))
    -- The part stands where it will, its edge is the line, and the scene has not got it.
    local part = shown.meshes[1].mesh
    expect.truthy(part:bounds().max[3] > 2)
    expect.truthy(#part:boundaries() == 1 and #part:boundaries()[1]:points() == #shown.lines[1].points)
    expect.truthy(rawequal(h.host:draw().meshes[1].mesh, part))
    expect.equal(#h.scene, 2)
    h:release{ 2.2, 0.3, 1.5 }
    expect.equal(h:steps(), 1)
    expect.equal(#h.host:draw().lines, 0)
    expect.equal(#h.host:draw().meshes, 0)
    local mesh = h.scene:get("target")
    expect.truthy(mesh:is_closed())
    expect.equal(mesh:components(), 1)
    expect.truthy(mesh:bounds().max[3] > 2)
    expect.equal(#h.scene, 2)
    expect.equal(h:there_and_back(), before)
end)

test("the loop follows, the wheel turns it, and shift and the wheel scale it", function()
    h:press{ 2, 0, 1.6 }
    local function length()
        local line, sum = h.host:draw().lines[1].points, 0
        for i, p in ipairs(line) do
            local q = line[i % #line + 1]
            sum = sum + math.sqrt((p[1] - q[1]) ^ 2 + (p[2] - q[2]) ^ 2 + (p[3] - q[3]) ^ 2)
        end
        return sum
    end
    local first, part = length(), h.host:draw().meshes[1].mesh
    h.host:wheel(h:at({ 2, 0, 1.6 }, { lines = 3 }))
    expect.equal(h.tool.params.angle, 15)
    expect.truthy(h.host:draw().meshes[1].mesh:hash() ~= part:hash())
    h.host:wheel(h:at({ 2, 0, 1.6 }, { lines = -4, shift = true }))
    expect.near(h.tool.params.scale, 0.7 / 1.05 ^ 4)
    expect.truthy(length() < 0.9 * first)
    h:release{ 2, 0, 1.6 }
    expect.equal(h:steps(), 1)
    expect.truthy(h.scene:get("target"):is_closed())
end)

test("the part is shown where its target stands, also if that is coarse", function()
    local coarse = lissom.shapes.sphere{ segments = 2, kind = "triangles", radius = 1.6 }
    local place = { { 1, 0, 0, 2 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } }
    h = hand.new("paste", { horn = horned(-3), target = egg() }, { ortho = 9.6, places = { target = place } })
    h.host:set{ scale = 0.7 }
    h:press{ 2, 0, 1.6 }
    local shown = h.host:draw()
    expect.near(shown.meshes[1].transform[1][4], 2)
    expect.near(shown.meshes[1].mesh:bounds().center[1], 0, 0.3)
    h.host:cancel()
    h = hand.new("paste", { horn = horned(-3), target = coarse:transform{ translate = { 2, 0, 0 } } },
        { ortho = 9.6 })
    h.host:set{ scale = 0.1 }
    h:press{ 2.1, 0.2, 1.6 }
    shown = h.host:draw()
    expect.equal(#shown.meshes, 1)
    h.host:cancel()
end)

test("the result is that of lissom.paste", function()
    local objects_of = objects()
    h:press{ 2, 0, 1.6 }
    h:move{ 2.1, 0.1, 1.6 }
    h:release{ 2.1, 0.1, 1.6 }
    local hit = h.camera:pick{ meshes = { objects_of.target }, x = h:at({ 2.1, 0.1, 1.6 }).x,
        y = h:at({ 2.1, 0.1, 1.6 }).y, size = { 1280, 960 } }
    local paste = lissom.paste{ source = objects_of.horn, target = objects_of.target,
        region = objects_of.horn:region("region"),
        placement = { at = hit.position, toward = "y", up = "y", angle = 0, scale = 0.7 } }
    paste:optimize()
    local mesh = paste:merge()
    mesh:remove_region("region")
    expect.equal(h.scene:get("target"):hash(), mesh:hash())
end)

test("where it does not fit the last good place stays, and the reason is told", function()
    h:press{ 2, 0, 1.6 }
    local points = h.host:draw().lines[1].points
    h.host:wheel(h:at({ 2, 0, 1.6 }, { lines = 70, shift = true }))
    local shown = h.host:draw()
    expect.equal(#shown.labels, 2)
    expect.falsy(shown.labels[1].text:find("energy", 1, true))
    expect.equal(#shown.lines[1].points, #points)
    expect.near(shown.lines[1].points[1], points[1])
    h:release{ 2, 0, 1.6 }
    expect.truthy(h.scene:get("target"):is_closed())
    expect.near(h.tool.params.scale, 0.7)
end)

test("nothing to paste, a drag beside the target, Escape, and another tool", function()
    local before = h.scene:hash()
    h:drag{ { -3, 0, 1.5 }, { -1, 3, 0 } }
    expect.equal(h:steps(), 0)
    h:press{ 2, 0, 1.6 }
    h:move{ 2.2, 0, 1.6 }
    h.host:cancel()
    expect.equal(h.scene:hash(), before)
    expect.equal(#h.host:draw().lines, 0)
    h:press{ 2, 0, 1.6 }
    h.host:use(lissom.load_tool("select"))
    expect.equal(h.scene:hash(), before)
    h = hand.new("paste", { target = egg() })
    expect.error(function() h:press{ 0, 0, 1.6 } end, "select the part first")
end)

test("what is selected is the part; of one mesh alone it is put onto itself", function()
    local ball = horned(0)
    ball:remove_region("region")
    ball:set_region("selected", ball:region{ sphere = { center = { 0, 0, 1.2 }, radius = 0.85 } })
    h = hand.new("paste", { ball = ball }, { eye = { 50, 0, 0 }, ortho = 9.6 })
    h.host:set{ scale = 0.6 }
    h:drag{ { 1, 0, -0.1 }, { 1, 0, -0.3 } }
    expect.equal(h:steps(), 1)
    local mesh = h.scene:get("ball")
    expect.truthy(mesh:is_closed())
    expect.truthy(mesh:bounds().max[1] > 1.2)
end)

test("several pastes, one after another, on what came out", function()
    h:drag{ { 2, 0.6, 1.6 }, { 2.1, 0.6, 1.6 } }
    h:drag{ { 2, -0.8, 1.6 }, { 2.1, -0.8, 1.6 } }
    expect.equal(h:steps(), 2)
    expect.truthy(h.scene:get("target"):is_closed())
    h:there_and_back()
end)

test("it is recorded and done again, and its journal is a script of calls", function()
    local recorded = hand.new("paste", objects(), { record = true, ortho = 9.6 })
    recorded.host:set{ scale = 0.7 }
    recorded:press{ -3, 0, 1.5 }
    recorded:move{ 2, 0.2, 1.6 }
    recorded.host:wheel(recorded:at({ 2, 0.2, 1.6 }, { lines = 2 }))
    recorded.host:wheel(recorded:at({ 2, 0.2, 1.6 }, { lines = 1, shift = true }))
    recorded:move{ 2.2, 0.3, 1.6 }
    recorded:release{ 2.2, 0.3, 1.6 }
    local file = test.file("recording.lua")
    local stream = assert(io.open(file, "w"))
    stream:write(recorded.host:recording())
    stream:close()
    local fresh = hand.new("select", objects())
    lissom.replay(file, { scene = fresh.scene })
    expect.equal(fresh.scene:hash(), recorded.scene:hash())
    local told, other = recorded.host:journal_text(), hand.new("select", objects())
    expect.falsy(told:find("record events instead"))
    expect.equal(select(2, told:gsub("lissom.paste", "")), 1)
    expect.equal(select(2, told:gsub(":optimize", "")), 1)
    assert(load(told, "=journal"))(other.scene)
    expect.equal(other.scene:hash(), recorded.scene:hash())
end)
