-- Strokes that no hand means: refused with what to do, nothing changes, and undo is one step a stroke.
local hand = require "hand"
local lissom = require "lissom"

local head = lissom.shapes.head{ vertices = 4000 }
local h, style

local function begin(tool, camera)
    style = lissom.hairstyle(head, { resolution = 5000 })
    h = hand.new(tool, { head = head, style = style }, { eye = { 0, 0, 2 }, ortho = 0.5 })
    if camera then
        h.camera = camera
        h.host:look(camera)
    end
    h.host:set{ strands = 50 }
    h.scene:clear_history()
end

local function draw(pixels)
    h.host:press{ x = pixels[1][1], y = pixels[1][2] }
    for i = 2, #pixels do h.host:move{ x = pixels[i][1], y = pixels[i][2] } end
    h.host:release{ x = pixels[#pixels][1], y = pixels[#pixels][2] }
end

-- A stroke that is refused with words, or does nothing ("nothing"): all is as before, and undo has no step
-- more. Or ("drawn") it is one step, and undo takes it back.
local function expect_outcome(pixels, outcome)
    local before, steps = h.scene:hash(), h:steps()
    local done, message = pcall(draw, pixels)
    h.host:draw()
    if outcome == "drawn" then
        expect.truthy(done, message)
        expect.equal(h:steps(), steps + 1)
        h.host:undo()
    elseif outcome == "nothing" then
        expect.truthy(done, message)
    else
        expect.falsy(done)
        expect.truthy(tostring(message):find(outcome, 1, true), message)
    end
    expect.equal(h:steps(), steps)
    expect.equal(h.scene:hash(), before)
    h.host:draw()
end

local function line(from, to, count)
    local list = {}
    for i = 0, count do
        local t = i / count
        list[i + 1] = { from[1] + t * (to[1] - from[1]), from[2] + t * (to[2] - from[2]) }
    end
    return list
end

local function eight(x, y, radius)
    local list = {}
    for i = 0, 40 do
        local turn = 2 * math.pi * i / 40
        list[i + 1] = { x + radius * math.sin(turn), y + radius * math.sin(2 * turn) }
    end
    return list
end

local strokes = {
    ["of one point"] = { { 640, 300 } },
    ["of one place"] = line({ 640, 300 }, { 640, 300 }, 20),
    ["of ten thousand points"] = line({ 640, 300 }, { 720, 420 }, 10000),
    ["off the window"] = line({ -900, -900 }, { -500, -300 }, 20),
    ["from the head out of the window"] = line({ 640, 300 }, { 5000, 4000 }, 20),
    ["across the silhouette and back"] = { { 640, 300 }, { 900, 300 }, { 1200, 320 },
        { 900, 340 }, { 640, 360 } },
    ["that crosses itself"] = eight(640, 300, 90),
    ["on the face"] = line({ 640, 560 }, { 660, 640 }, 10),
    ["nowhere near"] = line({ 20, 20 }, { 60, 60 }, 10),
}

-- What becomes of them: all but these are drawn.
local clicks = { ["of one point"] = "nothing", ["of one place"] = "nothing" }
local beside = "starts beside the surface; start it on the surface"
local outcomes = { ["off the window"] = beside, ["nowhere near"] = beside,
    ["on the face"] = "look at it from another side",
    ["parting from the head out of the window"] = "draw it on the scalp",
    ["parting across the silhouette and back"] = "draw it on the scalp",
    ["ponytail from the head out of the window"] = "hair can be" }

local function inside() return lissom.camera{ eye = { 0, 0.02, 0 }, target = { 0, 0.02, 0.1 } } end

for _, tool in ipairs{ "stream", "parting", "ponytail" } do
    for name, pixels in pairs(strokes) do
        test(tool .. ": a stroke " .. name, function()
            begin(tool)
            expect_outcome(pixels, clicks[name] or outcomes[tool .. " " .. name] or outcomes[name] or "drawn")
        end)
    end
    test(tool .. ": a camera inside the head", function()
        begin(tool, inside())
        expect_outcome(line({ 500, 300 }, { 700, 600 }, 12), "move it out")
    end)
end

test("mask: beside the head, and with a camera inside it", function()
    begin("mask")
    expect_outcome(strokes["nowhere near"], "begin on the head")
    expect_outcome(strokes["from the head out of the window"], "drawn")
    begin("mask", inside())
    expect_outcome(line({ 500, 300 }, { 700, 600 }, 12), "begin on the head")
end)

test("comb: without hair, and beside it", function()
    begin("comb")
    expect_outcome(strokes["of ten thousand points"], "there is no hair to comb: draw a stream first")
end)

test("a hint nowhere near its stream changes nothing; over the head it is another stream", function()
    begin("stream")
    draw(line({ 640, 300 }, { 760, 520 }, 20))
    local curve = style:curves()[1]
    h.host:click{ x = 700, y = 410 }
    expect.truthy(h.tool.curve == curve)
    local points = curve:points()
    expect_outcome(strokes["nowhere near"], beside)
    expect.equal(curve:points(), points)
    draw(line({ 560, 300 }, { 520, 420 }, 20))
    expect.equal(#style:curves(), 2)
    expect.equal(curve:points(), points)
end)

-- A tail seen from its left, and the pixels of its spine.
local function begin_tail()
    style = lissom.hairstyle(head, { resolution = 5000 })
    local scalp = style:scalp()
    h = hand.new("ponytail", { head = head, style = style }, { eye = { 2, 0, -0.1 }, target = { 0, 0, -0.1 },
        ortho = 0.5 })
    h.host:set{ strands = 50 }
    h.scene:clear_history()
    local route = {}
    for i, p in ipairs{ { 0, 0.04, -0.08 }, { 0, 0.04, -0.13 }, { 0, 0, -0.17 }, { 0, -0.08, -0.18 },
        { 0, -0.16, -0.18 } } do route[i] = scalp:from_metres(p) end
    h:drag(route, {}, 10)
    local pixels = {}
    for i, p in ipairs(style:curves()[1]:course()) do
        pixels[i] = { h.camera:project(p, { 1280, 960 }) }
    end
    return pixels
end

test("ponytail: a section that crosses itself is as wide as it is across the spine", function()
    local spine = begin_tail()
    local at = spine[4]
    draw(eight(at[1], at[2], 40))
    expect.equal(#style:curves(), 1)
    expect.equal(h:steps(), 2)
    local radius = style:curves()[1]:tie().radius / style:scalp():scale()
    expect.truthy(radius > 0.008 and radius < 0.03, radius)
end)

test("ponytail: half a section, and one that has no tail in it", function()
    local spine = begin_tail()
    local at, half = spine[4], {}
    for i = 0, 20 do
        local turn = math.pi * i / 20
        half[i + 1] = { at[1] + 40 * math.cos(turn), at[2] + 40 * math.sin(turn) }
    end
    expect_outcome(half, "all the way round the tail")
end)

test("ponytail: a profile that crosses the spine, and two on one side", function()
    local spine = begin_tail()
    local crossing, off = {}, {}
    for i = 3, #spine - 2 do
        local t = (i - 3) / (#spine - 5)
        crossing[#crossing + 1] = { spine[i][1] + 60 * (1 - 2 * t), spine[i][2] }
        off[#off + 1] = { spine[i][1] + 50, spine[i][2] }
    end
    draw(off)
    expect.truthy(#style:curves()[1]:profiles()[1] > 2)
    local before = style:curves()[1]:profiles()
    expect_outcome(crossing, "spine")
    expect.equal(style:curves()[1]:profiles(), before)
end)

test("a scalp with a hole: no stream begins in it, and one across it stays outside", function()
    local whole = head
    local bounds = whole:bounds()
    local top = { 0.02, bounds.max[2], 0.03 }
    local lid = whole:region{ sphere = { center = top, radius = 0.035 } }
    local _, rest = whole:cut{ region = lid }
    style = lissom.hairstyle(rest, { resolution = 5000 })
    local camera = { eye = { 0.02, 2, 0.9 }, target = { 0.02, bounds.max[2] - 0.03, 0 }, ortho = 0.4 }
    h = hand.new("stream", { head = rest, style = style }, camera)
    h.host:set{ strands = 50 }
    h.scene:clear_history()
    local x, y = h.camera:project(top, { 1280, 960 })
    expect_outcome(line({ x, y }, { x + 20, y + 30 }, 10), "through a hole")
    draw(line({ x - 140, y - 10 }, { x + 150, y + 15 }, 40))
    expect.equal(#style:curves(), 1)
    for i, point in ipairs(style:curves()[1]:course()) do
        local near = whole:nearest(point)
        local out = 0
        for k = 1, 3 do out = out + (point[k] - near.position[k]) * near.normal[k] end
        expect.truthy(i < 3 or out > 0, out)
    end
end)

test("no tool hears of pixels that are no numbers", function()
    begin("stream")
    local before = h.scene:hash()
    expect.error(function() h.host:press{ x = 0 / 0, y = 300 } end, "a number of pixels")
    expect.equal(h.scene:hash(), before)
end)
