local lissom = require "lissom"

local head = lissom.shapes.head{ vertices = 3000 }
local scalp = lissom.scalp(head)
local size = { 900, 900 }
local front = lissom.frame(head, { view = "front", size = size, margin = 0.2 })

-- A bow on the picture, from above the forehead down beside the face.
local function bow(side)
    local x, y = front:project(scalp:at{ azimuth = 20 * side, elevation = 60 }, size)
    local points = {}
    for i = 0, 60 do
        local t = i / 60
        points[#points + 1] = { x + side * 260 * math.sin(1.5 * t), y + 330 * t * t }
    end
    return points
end

test("a stroke over a head becomes a stream that hair follows", function()
    local style = lissom.hairstyle(head, { scalp = scalp, resolution = 5000 })
    for _, side in ipairs{ 1, -1 } do
        local drawn = front:stroke{ points = bow(side), on = scalp, size = size }
        expect.equal(drawn.click, false)
        expect.truthy(#drawn.points > 60)
        expect.equal(#drawn.times, #drawn.points)
        expect.near(head:nearest(drawn.points[1]).distance, 0, 1e-6)
        for i = 20, #drawn.points do
            expect.truthy(head:nearest(drawn.points[i]).distance > 0.0049 * scalp:scale())
        end
        style:add_stream{ points = drawn.points }
    end
    local hair = style:grow{ count = 300 }
    expect.equal(#hair, 300)
end)

test("the depth of the thesis keeps that of the last point over the scalp", function()
    local drawn = front:stroke{ points = bow(1), on = scalp, depth = "last", size = size }
    local _, _, last = front:project(drawn.points[#drawn.points], size)
    local _, _, before = front:project(drawn.points[#drawn.points - 20], size)
    expect.near(last, before, 1e-9)
end)

test("a stroke that starts off the scalp is refused, and says where it started", function()
    local drawn, message = pcall(front.stroke, front,
        { points = { { 3, 3 }, { 40, 40 }, { 90, 40 } }, on = scalp, size = size })
    expect.equal(drawn, false)
    expect.truthy(tostring(message):find("starts beside the surface", 1, true))
end)

test("on a mesh, on a plane, and on nothing", function()
    local camera = lissom.camera{ eye = { 0, 0, 5 } }
    local line = { { 640, 480 }, { 660, 480 }, { 700, 480 } }
    local box = lissom.shapes.box()
    expect.near(camera:stroke{ points = line, on = box, lift = 0.1 }.points[1][3], 0.6, 1e-9)
    local plane = { point = { 0, 0, 1 }, normal = { 0, 0, 1 } }
    expect.near(camera:stroke{ points = line, plane = plane }.points[2][3], 1, 1e-9)
    local flat = camera:stroke{ points = line, spacing = 10 }
    expect.equal(#flat.points, 0)
    expect.equal(#flat.pixels, 7)
    expect.equal(flat.pixels[7][1], 700)
    expect.error(function() camera:stroke{ points = line, on = box, plane = plane } end, "not both")
    expect.error(function() camera:stroke{ points = line, times = { 1 } } end, "one number for each point")
end)

test("a corner that was meant stays, and a short touch is a click", function()
    local camera, points = lissom.camera{ eye = { 0, 0, 5 } }, {}
    for i = 0, 40 do points[#points + 1] = { 300 + 5 * i, 400 } end
    for i = 1, 40 do points[#points + 1] = { 500, 400 + 5 * i } end
    local drawn = camera:stroke{ points = points }
    expect.equal(#drawn.corners, 1)
    local corner = drawn.pixels[drawn.corners[1]]
    expect.near(corner[1], 500, 3)
    expect.near(corner[2], 400, 3)
    local touch = camera:stroke{ points = { { 10, 10 }, { 12, 11 } }, times = { 0, 0.1 } }
    expect.equal(touch.click, true)
    expect.equal(#touch.pixels, 1)
end)
