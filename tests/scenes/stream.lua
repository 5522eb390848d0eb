-- Streams drawn by hand, and changed by hint strokes.
local hand = require "hand"
local lissom = require "lissom"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"

local head, style, h

-- The generated head seen from a side, in pixels of a tenth of a millimetre or so.
local function begin(azimuth, options)
    options = options or {}
    head = options.head or lissom.shapes.head{ vertices = 6000 }
    style = lissom.hairstyle(head, { resolution = 8000 })
    local bounds, angle = head:bounds(), math.rad(azimuth or 0)
    local center, far = bounds.center, 4 * bounds.diagonal
    local place = options.place
    if place then center = matrices.point(place, center) end
    h = hand.new("stream", { style = style }, {
        eye = { center[1] + far * math.sin(angle), center[2], center[3] + far * math.cos(angle) },
        target = center, ortho = 1.6 * bounds.diagonal, places = { style = place },
    })
    h.host:set{ strands = 300 }
    h.scene:clear_history()
end

-- Turns the camera about the head.
local function look(azimuth)
    local bounds, angle = head:bounds(), math.rad(azimuth)
    local center, far = bounds.center, 4 * bounds.diagonal
    h.camera = lissom.camera{ target = center, ortho = 1.6 * bounds.diagonal,
        eye = { center[1] + far * math.sin(angle), center[2], center[3] + far * math.cos(angle) } }
    h.host:look(h.camera)
end

local function over(azimuth, elevation, lift)
    return style:at{ azimuth = azimuth, elevation = elevation, lift = lift or 0 }
end

-- A stroke down the left side of the face, seen from in front.
local function side() return { over(20, 62), over(50, 35, 0.02), over(65, 5, 0.03), over(65, -25, 0.03) } end

local function length(points)
    local sum = 0
    for i = 2, #points do
        local a, b = points[i - 1], points[i]
        sum = sum + math.sqrt((a[1] - b[1]) ^ 2 + (a[2] - b[2]) ^ 2 + (a[3] - b[3]) ^ 2)
    end
    return sum
end

local function pixel(point) return { h.camera:project(point, { 1280, 960 }) } end

-- Drags over pixels.
local function draw(pixels, options)
    local function event(p)
        local all = { x = p[1], y = p[2] }
        for key, value in pairs(options or {}) do all[key] = value end
        return all
    end
    h.host:press(event(pixels[1]))
    for i = 2, #pixels do
        for step = 1, 6 do
            local t, a, b = step / 6, pixels[i - 1], pixels[i]
            h.host:move(event{ a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]) })
        end
    end
    h.host:release(event(pixels[#pixels]))
end

-- The pixel at a share of a curve, moved.
local function at(curve, share, x, y)
    local points = curve:course()
    local p = pixel(points[math.floor(share * (#points - 1) + 1.5)])
    return { p[1] + (x or 0), p[2] + (y or 0) }
end

local function choose(curve)
    local p = at(curve, 0.5)
    h.host:click{ x = p[1], y = p[2] }
end

local function drawn()
    h:drag(side(), nil, 8)
    return style:curves()[1]
end

test.before(function() begin() end)

test("a stroke from the scalp is a stream that hair follows, in one step", function()
    local before = h.scene:hash()
    local curve = drawn()
    expect.equal(#style:curves(), 1)
    expect.equal(h:steps(), 1)
    expect.equal(#h.scene:get("style hair"), 300)
    expect.near(length(curve:points()), length(side()), 0.35 * length(side()))
    for _, point in ipairs(curve:course()) do
        expect.truthy(style:scalp():head():nearest(point[1], point[2], point[3]).distance >= 0)
    end
    expect.equal(h:there_and_back(), before)
end)

test("a stroke that starts off the head is refused with the reason, and nothing has changed", function()
    local before = h.scene:hash()
    expect.error(function() draw{ { 30, 30 }, { 90, 200 }, { 200, 400 } } end, "starts beside the surface")
    expect.equal(h.scene:hash(), before)
    expect.equal(h:steps(), 0)
    drawn()
    expect.equal(#style:curves(), 1)
end)

test("a hint across a chosen stream cuts it", function()
    local curve = drawn()
    local before = length(curve:points())
    choose(curve)
    draw{ at(curve, 0.5, -45, 3), at(curve, 0.5, 45, 6) }
    expect.equal(#style:curves(), 1)
    expect.near(length(curve:points()), before / 2, 0.12 * before)
    h.host:undo()
    expect.near(length(curve:points()), before, 1e-9)
end)

test("a hint from a stream to elsewhere goes on there", function()
    local curve = drawn()
    choose(curve)
    local tip = at(curve, 1)
    draw{ tip, { tip[1] + 20, tip[2] + 60 }, { tip[1] + 10, tip[2] + 140 } }
    expect.equal(#style:curves(), 1)
    local last = pixel(curve:points()[#curve:points()])
    expect.near(last[2], tip[2] + 140, 8)
end)

test("a hint from a stream back to it takes the place of the part between", function()
    local curve = drawn()
    local a, b = at(curve, 0.4), at(curve, 0.85)
    local root, tip = curve:points()[1], curve:points()[#curve:points()]
    draw{ a, { a[1] + 60, (a[2] + b[2]) / 2 }, b }
    expect.equal(#style:curves(), 1)
    local farthest = 0
    for _, point in ipairs(curve:points()) do farthest = math.max(farthest, pixel(point)[1]) end
    expect.truthy(farthest > a[1] + 40)
    for k = 1, 3 do
        expect.near(curve:points()[1][k], root[k], 1e-9)
        expect.near(curve:points()[#curve:points()][k], tip[k], 1e-9)
    end
end)

test("Alt takes the next reading; the last one is a new stream", function()
    local curve = drawn()
    choose(curve)
    local p, q = at(curve, 0.5, -45, 3), at(curve, 0.5, 45, 6)
    h.host:press{ x = p[1], y = p[2] }
    for i = 1, 8 do h.host:move{ x = p[1] + i / 8 * (q[1] - p[1]), y = p[2] + i / 8 * (q[2] - p[2]) } end
    local function said() return h.host:draw().labels[1].text end
    expect.truthy(said():find("^cut"))
    expect.truthy(#style:curves() == 1)
    local names, word = {}
    repeat
        h.host:move{ x = q[1], y = q[2], alt = true }
        h.host:move{ x = q[1], y = q[2] }
        word = said():match("^%a+")
        names[#names + 1] = word
    until word == "cut" or #names > 4
    expect.truthy(#names > 1)
    expect.equal(word, "cut")
    h.host:release{ x = q[1], y = q[2] }
    expect.equal(#style:curves(), 1)
end)

test("from the side a hint changes the depth and keeps the look from in front", function()
    local curve = drawn()
    local before = {}
    for i, point in ipairs(curve:course()) do before[i] = pixel(point) end
    look(90)
    choose(curve)
    local a, b = at(curve, 0.55), at(curve, 1)
    draw{ a, { a[1] - 25, (a[2] + b[2]) / 2 }, { b[1] - 60, b[2] + 5 } }
    expect.truthy(h:steps() == 2)
    look(0)
    local function nearest(p)
        local best = math.huge
        for _, other in ipairs(before) do
            best = math.min(best, math.sqrt((p[1] - other[1]) ^ 2 + (p[2] - other[2]) ^ 2))
        end
        return best
    end
    local sum = 0
    for _, point in ipairs(curve:points()) do sum = sum + nearest(pixel(point)) end
    expect.truthy(sum / #curve:points() < 6, sum / #curve:points())
end)

test("symmetric: the other side is drawn, cut and removed too", function()
    h.host:set{ symmetric = true }
    drawn()
    local list = style:curves()
    expect.equal(#list, 2)
    choose(list[1])
    draw{ at(list[1], 0.5, -45, 3), at(list[1], 0.5, 45, 6) }
    expect.near(length(list[1]:points()), length(list[2]:points()), 1e-6)
    h.host:key{ key = "delete" }
    expect.equal(#style:curves(), 0)
    expect.equal(meshes.object(h.scene, "style hair"), nil)
end)

test("pull moves a place and what is near, and the root over the scalp; rub makes it straighter", function()
    local curve = drawn()
    h.host:set{ by = "pull" }
    local before, p = curve:course(), at(curve, 0.6)
    draw{ p, { p[1] + 50, p[2] } }
    expect.near(at(curve, 0.6)[1], p[1] + 50, 12)
    expect.near(pixel(curve:points()[1])[1], pixel(before[1])[1], 1e-6)
    local bent = length(curve:points())
    h.host:set{ by = "rub" }
    for _ = 1, 4 do
        local stroke = {}
        for i = 0, 6 do stroke[i + 1] = at(curve, 0.3 + 0.1 * i) end
        draw(stroke)
    end
    expect.truthy(length(curve:points()) < bent)
    h.host:set{ by = "pull" }
    local root = pixel(curve:course()[1])
    draw{ root, { root[1] + 15, root[2] + 10 } }
    local moved = curve:points()[1]
    expect.near(pixel(moved)[1], root[1] + 15, 2)
    expect.near(head:nearest(moved[1], moved[2], moved[3]).distance, 0, 1e-3 * head:size())
end)

test("m and tab: a mirror image, and the next stream", function()
    choose(drawn())
    h.host:key{ key = "m" }
    expect.equal(#style:curves(), 2)
    h.host:key{ key = "tab" }
    h.host:key{ key = "delete" }
    expect.equal(#style:curves(), 1)
end)

test("c: a copy that begins at the cursor; beside the head it says where to go", function()
    local curve = drawn()
    choose(curve)
    local root = pixel(curve:points()[1])
    local over_there = { root[1] - 60, root[2] + 10 }
    h.host:move{ x = over_there[1], y = over_there[2] }
    h.host:key{ key = "c" }
    local copy = style:curves()[2]
    local x, y = h.camera:project(copy:points()[1], { 1280, 960 })
    expect.near({ x, y }, over_there, 1)
    expect.near(length(copy:points()), length(curve:points()), 0.02 * length(curve:points()))
    expect.equal(h:steps(), 2)
    h.host:move{ x = 20, y = 20 }
    expect.error(function() h.host:key{ key = "c" } end, "at the new root of the copy")
    expect.equal(#style:curves(), 2)
end)

test("Escape, undo and the style's end in the middle of a stroke", function()
    local before = h.scene:hash()
    for _, interrupt in ipairs{ function() h.host:cancel() end, function() h.host:undo() end,
        function() h.scene:remove("style") end } do
        local route = side()
        h:press(route[1])
        h:move(route[2])
        h:move(route[3])
        interrupt()
        h:release(route[4])
        while h:steps() > 0 do h.host:undo() end
        expect.equal(h.scene:hash(), before)
        h.host:draw()
    end
end)

test("a style that is turned and moved in the scene", function()
    begin(0, { place = { { 0, -1, 0, 3 }, { 1, 0, 0, 1 }, { 0, 0, 1, -2 }, { 0, 0, 0, 1 } } })
    local place, list = h.scene:info("style").transform, {}
    for i, point in ipairs(side()) do list[i] = matrices.point(place, point) end
    h:drag(list, nil, 8)
    expect.equal(#style:curves(), 1)
    expect.near(length(style:curves()[1]:points()), length(side()), 0.35 * length(side()))
end)

test("without a hairstyle the tool says what to do", function()
    h = hand.new("stream", { box = lissom.shapes.box{} })
    expect.error(function() h:drag{ { 0, 0, 0 }, { 1, 0, 0 } } end, "no hairstyle")
end)

test("on a head alone the first stroke begins a hairstyle, in its own step", function()
    head = lissom.shapes.head{ vertices = 6000 }
    local bounds = head:bounds()
    h = hand.new("stream", { person = head }, { target = bounds.center, ortho = 1.6 * bounds.diagonal,
        eye = { bounds.center[1], bounds.center[2], bounds.center[3] + 4 * bounds.diagonal } })
    h.host:set{ strands = 100 }
    h.scene:clear_history()
    local before, other = h.scene:hash(), lissom.hairstyle(head, { resolution = 2000 })
    local x, y = h.camera:project(other:at{ azimuth = 20, elevation = 62 }, { 1280, 960 })
    draw{ { x, y }, { x + 90, y + 40 }, { x + 120, y + 200 } }
    expect.equal(h.scene:names(), { "person", "person style", "person style hair" })
    expect.equal(#h.scene:get("person style"):curves(), 1)
    expect.equal(h:steps(), 1)
    draw{ { x - 40, y }, { x - 120, y + 40 }, { x - 140, y + 200 } }
    expect.equal(#h.scene:get("person style"):curves(), 2)
    expect.equal(h:steps(), 2)
    expect.error(function() draw{ { 5, 5 }, { 50, 90 }, { 80, 120 } } end, "starts beside")
    expect.equal(h:there_and_back(), before)
    h.host:undo()
    h.host:undo()
    expect.error(function() draw{ { 5, 5 }, { 50, 90 }, { 80, 120 } } end, "starts beside")
    expect.equal(h.scene:hash(), before)
end)

test("a click on a head alone begins no hairstyle", function()
    head = lissom.shapes.head{ vertices = 6000 }
    local bounds = head:bounds()
    h = hand.new("stream", { person = head }, { target = bounds.center, ortho = 1.6 * bounds.diagonal,
        eye = { bounds.center[1], bounds.center[2], bounds.center[3] + 4 * bounds.diagonal } })
    local before = h.scene:hash()
    h.host:click{ x = 640, y = 400 }
    expect.equal(h.scene:hash(), before)
    expect.equal(h.scene:names(), { "person" })
end)

test("lift says how far off the skin a stream is drawn", function()
    local function height()
        local heights = {}
        for _, point in ipairs(drawn():course()) do
            table.insert(heights, head:nearest(point[1], point[2], point[3]).distance)
        end
        table.sort(heights)
        return heights[(#heights + 1) // 2] / style:scalp():scale()
    end
    local default = height()
    begin()
    h.host:set{ lift = 4 }
    local low = height()
    expect.truthy(low < default - 0.003, low .. " of " .. default)
end)

test("a stroke across a stream that was not chosen is told that it may be", function()
    drawn()
    h.host:click{ x = 5, y = 5 }
    expect.error(function() draw{ { 5, 5 }, { 50, 90 }, { 80, 120 } } end, "or click a curve first")
end)

test("a picture that changes its size lets go of the stroke", function()
    local before = h.scene:hash()
    local x, y = h.camera:project(style:at{ azimuth = 20, elevation = 62 }, { 1280, 960 })
    h.host:press{ x = x, y = y }
    h.host:move{ x = x + 60, y = y + 40 }
    h.host:move{ x = x + 90, y = y + 100 }
    h.host:look(h.camera, { 1000, 700 })
    expect.equal(h.scene:hash(), before)
    h.host:release{ x = x + 90, y = y + 100 }
    expect.equal(h:steps(), 0)
    h.host:look(h.camera, { 1280, 960 })
    drawn()
    expect.equal(h:steps(), 1)
end)

test("a stream that ends at a tie goes into it, as does its mirror image; hair goes on there", function()
    begin(90)
    local place = { azimuth = 115, elevation = 20, lift = 0.018 }
    local tie, out = style:at(place), style:normal_at(place)
    local spine, metre = { tie }, style:scalp():scale()
    for i = 1, 8 do
        spine[i + 1] = { tie[1] + 0.012 * i * out[1] * metre, tie[2] - 0.003 * i * i * metre,
            tie[3] + 0.012 * i * out[3] * metre }
    end
    local tails = { style:add_ponytail{ spine = spine, radius = 0.02 } }
    for _, point in ipairs(spine) do point[1] = 2 * style:scalp():center()[1] - point[1] end
    tails[2] = style:add_ponytail{ spine = spine, radius = 0.02 }
    local end_of = tails[1]:tie().center
    h.host:set{ symmetric = true }
    draw{ pixel(over(40, 55)), pixel(over(80, 45)), at(tails[1], 0, -22, -14) }
    local streams = { style:curves()[3], style:curves()[4] }
    expect.equal(#style:curves(), 4)
    for i, stream in ipairs(streams) do
        local points, ring = stream:points(), tails[i]:tie()
        expect.near(length{ points[#points], ring.center }, 0.5 * ring.radius, 0.05 * ring.radius)
        expect.equal(stream:options().stop, 0)
    end
    -- One that ends farther off is a stream as others are.
    draw{ pixel(over(40, 30)), pixel(over(70, 5)), { at(tails[1], 0)[1] - 150, at(tails[1], 0)[2] + 160 } }
    expect.truthy(length{ style:curves()[5]:points()[#style:curves()[5]:points()], end_of } > 0.05 * metre)
    expect.truthy(style:curves()[5]:options().stop > 0)
end)
