-- What is seen while hair is drawn: which curve a press would take, what the head hides, which way hair
-- grows, what is hard from here, and a tenth of the hair until the hand rests.
local hand = require "hand"
local lissom = require "lissom"

local head = lissom.shapes.head{ vertices = 6000 }
local size = { 1280, 960 }
local h, style

-- Looks at the head from a direction in degrees, 0 in front; a picture is `high` metres high.
local function look(azimuth, elevation, high)
    local scalp, a, e = style:scalp(), math.rad(azimuth), math.rad(elevation or 0)
    local eye = { 2 * math.cos(e) * math.sin(a), 2 * math.sin(e), 2 * math.cos(e) * math.cos(a) }
    h.camera = lissom.camera{ eye = scalp:from_metres(eye), target = scalp:center(),
        ortho = (high or 0.45) * scalp:scale() }
    h.host:look(h.camera)
end

local function over(azimuth, elevation, lift)
    return style:at{ azimuth = azimuth, elevation = elevation, lift = lift or 0 }
end

-- A hand with the stream tool and a stream on the left of the head.
test.before(function()
    style = lissom.hairstyle(head, { resolution = 8000 })
    style:add_stream{ points = { over(90, 60, 0.01), over(92, 30, 0.02), over(94, 0, 0.03),
        over(94, -25, 0.03) } }
    h = hand.new("stream", { head = head, style = style })
    h.host:set{ strands = 300 }
    look(90)
    h.scene:clear_history()
end)

local function pixel(point) return { h.camera:project(point, size) } end

local function place(curve, share)
    local course = curve:course()
    return pixel(course[math.floor(share * (#course - 1) + 1.5)])
end

local function hover(p) h.host:move{ x = p[1], y = p[2] } end

-- The outlines of a colour or opacity among what the tool shows.
local function outlines(field, value)
    local list = {}
    for _, one in ipairs(h.host:draw().outlines) do
        if one[field] == value then list[#list + 1] = one end
    end
    return list
end

local function press(p, options)
    h.host:press{ x = p[1], y = p[2], alt = options and options.alt }
end

local function moves(p, q, steps)
    for i = 1, steps or 8 do
        local t = i / (steps or 8)
        h.host:move{ x = p[1] + t * (q[1] - p[1]), y = p[2] + t * (q[2] - p[2]) }
    end
end

test("a curve glows where the cursor is near, and nowhere else", function()
    local p = place(style:curves()[1], 0.5)
    hover{ p[1] + 7, p[2] }
    expect.truthy(#outlines("color", "#ffd24a") > 0)
    hover{ p[1] + 40, p[2] }
    expect.equal(#outlines("color", "#ffd24a"), 0)
    look(-90)
    local behind = place(style:curves()[1], 0.5)
    hover(behind)
    expect.equal(#outlines("color", "#ffd24a"), 0)
end)

test("what the head hides of a curve is faint", function()
    expect.equal(#outlines("opacity", 0.3), 0)
    expect.truthy(#outlines("opacity", 1) > 0)
    look(-90)
    expect.truthy(#outlines("opacity", 0.3) > 0)
end)

test("arrows of the field lie on a slice that follows the cursor, as long as hair is grown", function()
    h.host:set{ field = true }
    local function middle()
        local x, y, arrows = 0, 0, outlines("color", "#f4f4f4")
        for _, one in ipairs(arrows) do x, y = x + one.pixels[1][1], y + one.pixels[1][2] end
        return x / #arrows, y / #arrows, #arrows
    end
    for _, p in ipairs{ { 640, 300 }, { 560, 420 } } do
        hover(p)
        local x, y, count = middle()
        expect.truthy(count > 30 and count <= 81, count)
        expect.near({ x, y }, p, 45)
    end
    style:curves()[1]:remove()
    expect.equal(#outlines("color", "#f4f4f4"), 0)
end)

-- From the side of the head straight away from it, seen end-on from there, and a little down.
local function outward()
    local scalp = style:scalp()
    local x, y, z = table.unpack(scalp:to_metres(over(90, 5, 0.005)))
    return { over(90, 5), scalp:from_metres(x + 0.03, y, z), scalp:from_metres(x + 0.06, y, z),
        scalp:from_metres(x + 0.1, y, z), scalp:from_metres(x + 0.11, y - 0.03, z) }
end

test("a curve seen end-on, and one seen from far, are told", function()
    local curve = style:curves()[1]
    curve:set_points(outward())
    look(90, 0)
    hover(pixel(curve:course()[#curve:course()]))
    expect.truthy(h.host:draw().labels[1].text:find("end-on", 1, true))
    h.host:press{ x = 640, y = 60 }
    h.host:cancel()
    curve:set_points{ over(90, 60, 0.01), over(92, 30, 0.02), over(94, 0, 0.03) }
    look(90, 0, 3)
    hover(place(curve, 0.5))
    expect.truthy(h.host:draw().labels[1].text:find("come nearer", 1, true))
end)

test("a hint to a curve seen end-on offers the strip, and says so", function()
    local curve = style:curves()[1]
    curve:set_points(outward())
    h.tool.state.viewpoint = h.camera
    look(150)
    local p = place(curve, 0.5)
    press(place(curve, 0))
    h.host:release{ x = place(curve, 0)[1], y = place(curve, 0)[2] }
    h.host:set{ surface = "ruled" }
    press{ p[1], p[2] - 50 }
    moves({ p[1], p[2] - 50 }, { p[1] + 4, p[2] + 50 })
    local said = h.host:draw().labels[1].text
    expect.truthy(said:find("strip", 1, true), said)
    h.host:cancel()
end)

test("v: hints are drawn on the strip seen from here, or on the surface of the old view", function()
    local curve = style:curves()[1]
    local function mode()
        local p = place(curve, 0.6)
        press{ p[1] - 45, p[2] }
        moves({ p[1] - 45, p[2] }, { p[1] + 45, p[2] + 4 })
        local support, shown = h.tool.stroke.support, h.host:draw().surfaces
        expect.equal(#shown, 1)
        expect.truthy(#shown[1].from == #shown[1].to and shown[1].opacity < 0.5)
        local found = support:mode()
        h.host:cancel()
        return found
    end
    h.tool.state.viewpoint = h.camera
    hover(place(curve, 0.5))
    press(place(curve, 0.5))
    h.host:release{ x = place(curve, 0.5)[1], y = place(curve, 0.5)[2] }
    expect.equal(mode(), "strip")
    look(160)
    expect.equal(mode(), "ruled")
    h:key("v")
    expect.equal(mode(), "strip")
    h.host:set{ surface = "ruled" }
    look(90)
    expect.equal(mode(), "ruled")
end)

test("while a stroke is drawn a tenth of the hair follows it, at rest all", function()
    local route = { over(40, 60), over(60, 35, 0.02), over(65, 0, 0.03) }
    look(60)
    h:press(route[1])
    for i = 2, 3 do
        moves(pixel(route[i - 1]), pixel(route[i]), 6)
        expect.equal(#h.scene:get("style hair"), 30)
        expect.equal(#style:curves(), 2)
    end
    h:release(route[3])
    expect.equal(#h.scene:get("style hair"), 300)
    local first = style:field(over(65, 10, 0.02))
    h.host:undo()
    expect.equal(#h.scene:get("style hair"), 300)
    local before = style:field(over(65, 10, 0.02))
    expect.truthy(math.abs(first[1] - before[1]) + math.abs(first[3] - before[3]) > 1e-3)
end)

test("a hint that may be taken otherwise is marked; what it does is seen before the button is up", function()
    local curve = style:curves()[1]
    press(place(curve, 0.5))
    h.host:release{ x = place(curve, 0.5)[1], y = place(curve, 0.5)[2] }
    local marked, plain = 0, 0
    for side = -1, 1, 2 do
        for start = 4, 20, 4 do
            local p, before = place(curve, 0.55), #curve:points()
            local from = { p[1] + side * start, p[2] }
            press(from)
            moves(from, { p[1] - side * 70, p[2] + 60 })
            local said = h.host:draw().labels[1].text
            expect.truthy(said:find("^%a+"))
            expect.truthy(said:find("Alt: ", 1, true))
            marked, plain = marked + (said:find("?", 1, true) and 1 or 0), plain + 1
            expect.truthy(#curve:points() ~= before or said:find("^stream"), said)
            h.host:cancel()
            expect.equal(#curve:points(), before)
        end
    end
    expect.truthy(marked > 0 and marked < plain, marked .. " of " .. plain)
end)

test("of several curves under the cursor Tab takes the next", function()
    local first = style:curves()[1]
    local points = {}
    for i, point in ipairs(first:points()) do points[i] = { point[1] + 0.001, point[2], point[3] } end
    local second = style:add_stream{ points = points }
    style:add_stream{ points = { over(0, 60, 0.01), over(0, 20, 0.02) } }
    hover(place(first, 0.5))
    press(place(first, 0.5))
    h.host:release{ x = place(first, 0.5)[1], y = place(first, 0.5)[2] }
    local chosen = h.tool.curve
    for _ = 1, 4 do
        h:key("tab")
        local other = h.tool.curve
        expect.truthy(other ~= chosen and (other == first or other == second))
        chosen = other
    end
end)
