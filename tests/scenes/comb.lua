-- Hair combed and masked by hand, and whole styles sketched without a window.
local hand = require "hand"
local lissom = require "lissom"

local size = { 1280, 960 }
local head, style, h

local function seen_from(azimuth)
    local bounds, angle = head:bounds(), math.rad(azimuth)
    local center, far = bounds.center, 4 * bounds.diagonal
    return { target = center, ortho = 1.6 * bounds.diagonal,
        eye = { center[1] + far * math.sin(angle), center[2], center[3] + far * math.cos(angle) } }
end

local function over(azimuth, elevation, lift)
    return style:at{ azimuth = azimuth, elevation = elevation, lift = lift or 0 }
end

-- Seen from its left: a head with hair that falls down its left side.
local function begin(tool)
    head = lissom.shapes.head{ vertices = 6000 }
    style = lissom.hairstyle(head, { resolution = 8000 })
    for _, azimuth in ipairs{ -90, 60, 90, 120 } do
        style:add_stream{ points = { over(azimuth, 65, 0.01), over(azimuth, 35, 0.02), over(azimuth, 0, 0.03),
            over(azimuth, -30, 0.03) } }
    end
    h = hand.new(tool, { style = style }, seen_from(90))
    h.scene:add("style hair", style:grow{ count = 2000 })
    h.host:set{ strands = 2000 }
    h.scene:clear_history()
end

local function backwards() return { over(75, 20, 0.02), over(100, 20, 0.02), over(125, 20, 0.02) } end

-- How far the field is from a way at its middle, in degrees.
local function off(way)
    local a, b, c = way[1], way[2], way[3]
    local v, w = style:field(b), { c[1] - a[1], c[2] - a[2], c[3] - a[3] }
    local dot, vv, ww = 0, 0, 0
    for k = 1, 3 do dot, vv, ww = dot + v[k] * w[k], vv + v[k] ^ 2, ww + w[k] ^ 2 end
    return math.deg(math.acos(dot / math.sqrt(vv * ww)))
end

test("hair flows as it was combed, in one step, and a second time nothing changes", function()
    begin("comb")
    local before = h.scene:hash()
    expect.truthy(off(backwards()) > 45)
    h:drag(backwards(), nil, 8)
    expect.equal(h:steps(), 1)
    expect.truthy(off(backwards()) < 30)
    local combed = h.scene:hash()
    h:drag(backwards(), nil, 8)
    expect.equal(h.scene:hash(), combed)
    expect.equal(h:there_and_back(), before)
end)

test("a comb only bends, or only adds, where it is told so", function()
    begin("comb")
    h.host:set{ by = "bend" }
    h:drag(backwards(), nil, 8)
    expect.equal(#style:curves(), 4)
    h.host:undo()
    h.host:set{ by = "add" }
    h:drag(backwards(), nil, 8)
    expect.equal(#style:curves(), 5)
end)

test("a comb beside all hair, and one without hair, is refused, and nothing changes", function()
    begin("comb")
    local before = h.scene:hash()
    local function beside()
        h.host:press{ x = 20, y = 20 }:move{ x = 60, y = 30 }:release{ x = 120, y = 40 }
    end
    expect.error(beside, "no hair is seen")
    expect.equal(h.scene:hash(), before)
    h.scene:remove("style hair")
    h.scene:clear_history()
    expect.error(function() h:drag(backwards(), nil, 8) end, "no hair to comb")
    expect.equal(h:steps(), 0)
end)

test("hair is shorter where that was painted, in one step, and delete takes it away", function()
    begin("mask")
    local before, length = h.scene:hash(), h.scene:get("style hair"):stats().mean_length
    h.host:set{ value = 0.1, radius = 0.05 }
    h:drag({ over(70, 40), over(110, 40) }, nil, 8)
    expect.equal(h:steps(), 1)
    expect.equal(style:masks()[1].kind, "length")
    expect.truthy(h.scene:get("style hair"):stats().mean_length < 0.97 * length)
    expect.equal(h:there_and_back(), before)
    h:key("delete")
    expect.equal(#style:masks(), 0)
    expect.near(h.scene:get("style hair"):stats().mean_length, length, 1e-6)
end)

test("a painted parting is as wide as the brush; a mask that starts beside the head is refused", function()
    begin("mask")
    h.host:set{ kind = "parting", radius = 0.004 }
    h:drag({ over(60, 45), over(110, 45) }, nil, 8)
    local curve = style:curves()[5]
    expect.equal(curve:kind(), "dividing")
    expect.near(curve:options().gap, 0.008, 1e-9)
    local steps = h:steps()
    expect.error(function() h.host:press{ x = 5, y = 5 } end, "begin on the head")
    expect.equal(h:steps(), steps)
end)

-- ---- style:sketch

local function pixels(points, camera)
    local list = {}
    for i = 2, #points do
        for step = 0, 5 do
            local t, at = step / 6, {}
            for k = 1, 3 do at[k] = points[i - 1][k] + t * (points[i][k] - points[i - 1][k]) end
            list[#list + 1] = { camera:project(at, size) }
        end
    end
    return list
end

test("what is sketched by strokes is what a hand draws with the tools", function()
    begin("stream")
    local way = { over(60, 60), over(85, 30, 0.02), over(90, -10, 0.03) }
    local bare = lissom.hairstyle(head, { resolution = 8000 })
    local camera = lissom.camera(seen_from(90))
    local done, hair = bare:sketch({
        { tool = "stream", points = pixels(way, camera), params = { symmetric = true } },
        { tool = "mask", points = pixels({ over(70, 40), over(110, 40) }, camera), params = { value = 0.2 } },
        { tool = "comb", points = pixels(backwards(), camera) },
    }, { camera = camera, strands = 500 })
    expect.equal(#done[1].added, 2)
    expect.truthy(done[2].changed and done[3].changed)
    expect.equal(#bare:masks(), 1)
    expect.equal(#hair, 500)
end)

test("where a stroke of a sketch is refused, none is drawn, and the error says which", function()
    begin("stream")
    local bare = lissom.hairstyle(head, { resolution = 8000 })
    local camera = lissom.camera(seen_from(90))
    local way = pixels({ over(60, 60), over(85, 30, 0.02), over(90, -10, 0.03) }, camera)
    local function sketch(strokes) return function() bare:sketch(strokes, { camera = camera }) end end
    local beside = { { 5, 5 }, { 60, 90 }, { 99, 99 } }
    expect.error(sketch{ { tool = "stream", points = way }, { points = beside } }, "stroke 2: ")
    expect.equal(#bare:curves(), 0)
    expect.error(sketch{ { points = way } }, "names no tool")
    expect.error(sketch{ { tool = "stream" } }, "its points, or a key")
    expect.error(sketch{ { tool = "stream", points = {} } }, "a list of pixels")
    expect.error(sketch{ { tool = "stream", points = way, speed = 3 } }, "no field 'speed'")
    expect.error(sketch{ { tool = 7, points = way } }, "its tool is a name")
    expect.error(sketch{ { tool = "stream", params = 3, points = way } }, "a table of values")
    expect.error(sketch{ { tool = "stream", camera = {}, points = way } }, "a result of lissom.camera")
    expect.error(sketch{ { tool = "stream", points = { { 0 / 0, 1 } } } }, "is not a pixel")
    local _, problem = lissom.try(sketch{ { tool = "stream", points = beside } })
    expect.truthy(problem.message:find("^stroke 1: the stroke starts"))
    expect.truthy(problem.place:find("comb.lua:%d+$"))
    expect.error(function() bare:sketch{ { tool = "stream", points = way } } end, "needs a camera")
    expect.equal(#bare:sketch({}, { camera = camera }), 0)
end)
