-- Lines drawn on surfaces.
local hand = require "hand"
local lissom = require "lissom"

local h, ball

local function begin(options)
    ball = lissom.shapes.sphere{ kind = "triangles", segments = 24 }
    h = hand.new("line", { ball = ball }, options or { ortho = 3 })
end

test.before(function() begin() end)

local function arc(radius, from, to)
    local list = {}
    for i = 0, 16 do
        local turn = math.rad(from + i / 16 * (to - from))
        list[i + 1] = { radius * math.cos(turn), radius * math.sin(turn), 0 }
    end
    return list
end

test("a stroke is a line on the surface, one step; backspace takes it away", function()
    local before = h.scene:hash()
    h:drag(arc(0.6, 0, 150))
    expect.equal(h.scene:names(), { "ball", "ball line" })
    local line = h.scene:get("ball line")
    expect.falsy(line:is_closed())
    expect.near(line:length(), math.rad(150) * 0.6, 0.05)
    for _, p in ipairs(line:points()) do expect.truthy(ball:nearest(p[1], p[2], p[3]).distance < 1e-9) end
    expect.equal(h:steps(), 1)
    h:key("backspace", "backspace")
    expect.equal(h.scene:names(), { "ball" })
    expect.equal(h:steps(), 2)
    expect.equal(h:there_and_back(), before)
end)

test("back to where it began it is closed; with shift the last one goes on", function()
    h:drag(arc(0.6, 0, 358))
    expect.truthy(h.scene:get("ball line"):is_closed())
    h:drag(arc(0.6, 0, 90))
    local length = h.scene:get("ball line 2"):length()
    h:drag(arc(0.6, 90, 180), { shift = true })
    expect.equal(#h.scene, 3)
    expect.near(h.scene:get("ball line 2"):length(), 2 * length, 0.05)
    h:there_and_back()
end)

test("by edges: along the edges of faces", function()
    h.host:set{ by = "edges" }
    h:drag(arc(0.6, 0, 120))
    local positions, corners = ball:positions(), {}
    for v = 1, #ball do
        corners[string.format("%.6f %.6f %.6f", positions[3 * v - 2], positions[3 * v - 1],
            positions[3 * v])] = true
    end
    local points = h.scene:get("ball line"):points()
    expect.truthy(#points > 4)
    for _, p in ipairs(points) do
        expect.truthy(corners[string.format("%.6f %.6f %.6f", p[1], p[2], p[3])])
    end
end)

test("what leaves the mesh ends there; strokes beside it and too short ones are refused", function()
    local before = h.scene:hash()
    expect.error(function() h:drag{ { 2, 0, 0 }, { 2, 1, 0 } } end, "draw over a mesh")
    h:click{ 0, 0, 0 }
    expect.equal(h.scene:hash(), before)
    h:drag{ { 0, 0, 0 }, { 0.5, 0, 0 }, { 1.5, 0, 0 } }
    local points = h.scene:get("ball line"):points()
    expect.truthy(points[#points][1] > 0.9)
    h:press{ 0, 0, 0 }
    h:move{ 0.2, 0, 0 }
    h.host:cancel()
    h:release{ 0.2, 0.2, 0 }
    expect.equal(#h.scene, 2)
end)

test("on a mesh that stands elsewhere, turned and twice as large", function()
    begin{ places = { ball = { { 0, -2, 0, 1 }, { 2, 0, 0, 0 }, { 0, 0, 2, 0 }, { 0, 0, 0, 1 } } } }
    h:drag{ { 1, -1, 0 }, { 1, 0, 0 }, { 1, 1, 0 } }
    local line = h.scene:get("ball line")
    expect.near(line:length(), math.rad(60), 0.06)
    expect.equal(h.scene:info("ball line").transform[1][4], 1)
end)
