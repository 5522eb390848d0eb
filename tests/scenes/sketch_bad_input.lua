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

-- Either nothing is changed, with or without an error that says something, or it is one step.
local function survives(pixels)
    local before, steps = h.scene:hash(), h:steps()
    local done, message = pcall(draw, pixels)
    if not done then expect.truthy(#tostring(message) > 10) end
    if h:steps() == steps then
        expect.equal(h.scene:hash(), before)
    else
        expect.equal(h:steps(), steps + 1)
        h.host:undo()
        expect.equal(h.scene:hash(), before)
    end
    h.host:draw()
    return done
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
    ["off the window"] = line({ -900, -900 }, { -500, -300 }, 20),
    ["from the head out of the window"] = line({ 640, 300 }, { 5000, 4000 }, 20),
    ["across the silhouette and back"] = { { 640, 300 }, { 900, 300 }, { 1200, 320 },
        { 900, 340 }, { 640, 360 } },
    ["that crosses itself"] = eight(640, 300, 90),
    ["nowhere near"] = line({ 20, 20 }, { 60, 60 }, 10),
}

for _, tool in ipairs{ "stream", "parting", "ponytail" } do
    for name, pixels in pairs(strokes) do
        test(tool .. ": a stroke " .. name, function()
            begin(tool)
            survives(pixels)
        end)
    end
    test(tool .. ": a camera inside the head", function()
        begin(tool, lissom.camera{ eye = { 0, 0.02, 0 }, target = { 0, 0.02, 0.1 } })
        survives(line({ 500, 300 }, { 700, 600 }, 12))
    end)
end

test("no tool hears of pixels that are no numbers", function()
    begin("stream")
    local before = h.scene:hash()
    expect.error(function() h.host:press{ x = 0 / 0, y = 300 } end, "a number of pixels")
    expect.equal(h.scene:hash(), before)
end)
