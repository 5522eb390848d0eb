-- Ponytails drawn by hand.
local hair = require "tools.support.hair"
local hand = require "hand"
local lissom = require "lissom"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"
local vectors = require "vectors"

local head = lissom.shapes.head{ vertices = 6000 }
local scalp = lissom.scalp(head)
local h, style

-- A point of the head's frame, in metres.
local function at(x, y, z) return h.world(scalp:from_metres(x, y, z)) end

-- A hand behind a head and to its left; `place` is where the head stands.
local function begin(place, eye)
    style = lissom.hairstyle(head, { scalp = scalp, resolution = 6000 })
    local function world(point) return place and matrices.point(place, point) or point end
    h = hand.new("ponytail", { head = head, style = style }, {
        eye = world(scalp:from_metres(table.unpack(eye or { 0.6, 0.1, -0.3 }))),
        target = world(scalp:from_metres(0, 0, -0.05)), fov = 30,
        places = place and { head = place, style = place } or nil,
    })
    h.world = world
    h.host:set{ strands = 200 }
    h.scene:clear_history()
end

test.before(function() begin() end)

local function tails() return hair.curves(hair.find(h.scene), "ponytail") end

-- A spine away from the back of the head and down.
local function draw_spine(options)
    h:drag({ at(0, 0.03, -0.085), at(0, 0.035, -0.13), at(0, 0, -0.17), at(0, -0.06, -0.185),
        at(0, -0.14, -0.19) }, options, 12)
end

-- A circle in the picture around a point, of a radius in metres.
local function draw_ring(center, radius, share)
    local right, up, metre = h.camera:right(), h.camera:up(), scalp:scale()
    local points = {}
    for i = 0, 24 do
        local turn = 2 * math.pi * (share or 1) * i / 24
        local side = vectors.plus(center, right, math.cos(turn) * radius * metre)
        points[i + 1] = vectors.plus(side, up, math.sin(turn) * radius * metre)
    end
    h:drag(points, {}, 2)
end

-- Along the tail as it is seen, `away` metres to the right of it.
local function draw_profile(away, options)
    local course, points = tails()[1]:course(), {}
    for i = 2, #course - 2 do
        points[#points + 1] = vectors.plus(h.world(course[i]), h.camera:right(), away * scalp:scale())
    end
    h:drag(points, options, 4)
end

test("a stroke away from the head is a tail, one step, tied off the head", function()
    local before = h.scene:hash()
    draw_spine()
    expect.equal(h:steps(), 1)
    expect.equal(tails()[1]:name(), "ponytail")
    expect.equal(#h.scene:get("style hair"), 200)
    local tie = tails()[1]:tie()
    local height = head:nearest(tie.center).distance / scalp:scale()
    expect.truthy(height > 0.015 and height < 0.03)
    expect.equal(h:there_and_back(), before)
    h.host:draw()
end)

test("round it: the tie, as wide as it was drawn; half way round says what to do", function()
    draw_spine()
    local course = tails()[1]:course()
    draw_ring(h.world(course[4]), 0.017)
    expect.near(tails()[1]:tie().radius, 0.017, 0.0015)
    expect.equal(h:steps(), 2)
    local before = h.scene:hash()
    expect.error(function() draw_ring(h.world(course[4]), 0.017, 0.5) end, "all the way round")
    expect.equal(h.scene:hash(), before)
    draw_ring(h.world(course[3]), 0.03, 1.1)
    expect.near(tails()[1]:tie().radius, 0.03, 0.003)
    h:there_and_back()
end)

test("along it: how it swells; a second one on its side takes its place", function()
    draw_spine()
    draw_ring(h.world(tails()[1]:course()[3]), 0.017)
    draw_profile(0.03)
    local first = tails()[1]:profiles()
    expect.truthy(#first[1] > 5 and #first[2] == 0)
    draw_profile(-0.04)
    local both = tails()[1]:profiles()
    expect.truthy(#both[1] == #first[1] and #both[2] > 5)
    draw_profile(0.035)
    expect.truthy(#tails()[1]:profiles()[2] == #both[2])
    expect.equal(#tails(), 1)
    expect.equal(h:steps(), 5)
    h:there_and_back()
end)

test("its handles: where hair is drawn into the tie, and how firmly", function()
    begin(nil, { 0.4, 0.1, -0.5 })
    draw_spine()
    local options = tails()[1]:options()
    local function handle(number)
        local list = h.host:draw().points
        return list[#list - 3 + number].points[1]
    end
    local center = h.world(tails()[1]:tie().center)
    local function to(point, factor) return vectors.plus(center, vectors.plus(point, center, -1), factor) end
    h:drag{ handle(3), to(handle(3), 1.3) }
    expect.truthy(tails()[1]:options().tightness > options.tightness + 0.1)
    expect.near(h.tool.params.tightness, tails()[1]:options().tightness, 1e-9)
    h:drag{ handle(1), to(handle(1), 1.2) }
    expect.near(tails()[1]:options().inner, 1.2 * options.inner, 0.15)
    h:drag{ handle(2), to(handle(2), 0.2) }
    local last = tails()[1]:options()
    expect.near(last.outer, last.inner, 1e-6)
    expect.near(last.ring, 0, 1e-6)
    expect.equal(h:steps(), 4)
    expect.equal(#h.scene:get("style hair"), 200)
    h:there_and_back()
end)

test("several tails: tab and clicks choose, shift draws another, delete removes; the panel", function()
    begin(nil, { 0, 0.15, -0.7 })
    local function side(sign, options)
        h:drag({ at(0.07 * sign, 0.02, -0.07), at(0.1 * sign, 0.02, -0.1), at(0.13 * sign, -0.06, -0.1),
            at(0.13 * sign, -0.14, -0.1) }, options, 12)
    end
    side(1)
    side(-1)
    expect.equal(#tails(), 2)
    expect.truthy(h.tool.curve == tails()[2])
    h:key("tab")
    expect.truthy(h.tool.curve == tails()[1])
    h.host:set{ tightness = 0.9 }
    expect.near(tails()[1]:options().tightness, 0.9)
    expect.near(tails()[2]:options().tightness, 0.6)
    local course = tails()[2]:course()
    h:click(course[#course - 2])
    expect.truthy(h.tool.curve == tails()[2])
    expect.near(h.tool.params.tightness, 0.6)
    side(-1, { shift = true })
    expect.equal(#tails(), 3)
    h:key("delete", "delete", "delete", "delete", "tab")
    expect.equal(#tails(), 0)
    expect.falsy(meshes.object(h.scene, "style hair"))
    h:there_and_back()
end)

test("off the head, half round the tail: refused with a reason, and nothing changes", function()
    local before = h.scene:hash()
    expect.error(function() h:drag{ at(0, 0.2, -0.3), at(0, 0, -0.3) } end, "")
    expect.equal(h.scene:hash(), before)
    draw_spine()
    before = h.scene:hash()
    local center = h.world(tails()[1]:course()[4])
    expect.error(function() draw_ring(center, 0.02, 0.6) end, "half a ring")
    expect.equal(h.scene:hash(), before)
end)

-- A stroke over pixels of the picture.
local function draw_pixels(pixels)
    h.host:press{ x = pixels[1][1], y = pixels[1][2] }
    for i = 2, #pixels do
        local a, b = pixels[i - 1], pixels[i]
        for step = 1, 8 do
            h.host:move{ x = a[1] + step / 8 * (b[1] - a[1]), y = a[2] + step / 8 * (b[2] - a[2]) }
        end
    end
    h.host:release{ x = pixels[#pixels][1], y = pixels[#pixels][2] }
end

local function length(points)
    local sum = 0
    for i = 2, #points do sum = sum + vectors.length(vectors.plus(points[i], points[i - 1], -1)) end
    return sum
end

local function pixel(point)
    local x, y = h.camera:project(h.world(point), { 1280, 960 })
    return { x, y }
end

test("across the tail: cut there, which Alt makes another tail; from its tip: it goes on", function()
    draw_spine()
    local before, course = length(tails()[1]:points()), tails()[1]:course()
    local middle = pixel(course[math.floor(0.6 * #course)])
    draw_pixels{ { middle[1] - 50, middle[2] + 4 }, { middle[1] + 50, middle[2] - 4 } }
    expect.equal(#tails(), 1)
    local cut = length(tails()[1]:points())
    expect.truthy(cut < 0.8 * before and cut > 0.3 * before, cut / before)
    local points = tails()[1]:points()
    local tip = pixel(points[#points])
    draw_pixels{ tip, { tip[1] + 10, tip[2] + 60 }, { tip[1] + 60, tip[2] + 140 } }
    expect.equal(#tails(), 1)
    expect.truthy(length(tails()[1]:points()) > 1.2 * cut)
    expect.equal(h:steps(), 3)
    h:there_and_back()
end)

test("drawn from behind its depth is a guess, and it says so; from the side it is drawn right", function()
    begin(nil, { 0, 0.05, -0.9 })
    local function true_point(t) return at(0, 0.05 - 0.2 * t * t, -0.11 - 0.12 * t * (1.6 - t)) end
    local route = {}
    for i = 0, 8 do route[i + 1] = true_point(i / 8) end
    table.insert(route, 1, at(0, 0.06, -0.08))
    h:drag(route, nil, 6)
    expect.truthy(h.tool.advice.text:find("guess"))
    expect.truthy(h.host:draw().labels[1].text:find("90 degrees"))
    h.host:undo()
    expect.equal(#h.host:draw().labels, 0)
    h.host:redo()
    local function off()
        local worst, points = 0, tails()[1]:points()
        for i = 1, 8 do worst = math.max(worst, hair.distance(points, true_point(i / 8))) end
        return worst
    end
    local guessed = off()
    h.camera = lissom.camera{ eye = at(0.9, 0.05, -0.1), target = at(0, 0, -0.1), fov = 30 }
    h.host:look(h.camera)
    local pixels = { pixel(tails()[1]:course()[1]) }
    for i = 2, 8 do pixels[i] = pixel(true_point(i / 8)) end
    draw_pixels(pixels)
    expect.equal(#tails(), 1)
    expect.truthy(off() < 0.012 and off() < 0.4 * guessed, off() .. " of " .. guessed)
    expect.equal(h:steps(), 2)
    h:there_and_back()
end)

test("what a stroke is taken for stands at the cursor with the surface that it is drawn on", function()
    draw_spine()
    local course = tails()[1]:course()
    local a, b = pixel(course[3]), pixel(course[#course - 2])
    h.host:press{ x = a[1] + 45, y = a[2] }
    for i = 1, 10 do
        h.host:move{ x = a[1] + 45 + i / 10 * (b[1] - a[1]), y = a[2] + i / 10 * (b[2] - a[2]) }
    end
    local marks = h.host:draw()
    expect.truthy(marks.labels[1].text:find("^profile"))
    expect.equal(#marks.surfaces, 1)
    expect.truthy(#tails()[1]:profiles()[1] > 2)
    h.host:move{ x = b[1] + 45, y = b[2], alt = true }
    expect.falsy(h.host:draw().labels[1].text:find("^profile"))
    h.host:cancel()
    expect.equal(#tails()[1]:profiles()[1], 0)
end)

test("on a head that stands elsewhere, turned and twice as large", function()
    begin{ { 0, 0, 2, 30 }, { 0, 2, 0, -7 }, { -2, 0, 0, 3 }, { 0, 0, 0, 1 } }
    draw_spine()
    draw_ring(h.world(tails()[1]:course()[4]), 0.034)
    expect.near(tails()[1]:tie().radius, 0.017, 0.0015)
    expect.near(h.scene:info("style hair").transform[1][4], 30)
    h:there_and_back()
end)

test("the style goes, or there is none; Escape in the middle", function()
    h:press(at(0, 0.03, -0.085))
    h:move(at(0, 0, -0.17))
    h.host:cancel()
    h:release(at(0, 0, -0.17))
    expect.equal(#style:curves(), 0)
    draw_spine()
    h:press(at(0, 0.03, -0.085))
    h.scene:remove("style")
    h:move(at(0, 0, -0.17))
    h:release(at(0, 0, -0.17))
    h:key("tab", "delete")
    h.host:set{ fullness = 2 }
    h.host:draw()
    h.scene:remove("head")
    expect.error(function() h:press(at(0, 0.03, -0.085)) end, "no hairstyle")
    while h:steps() > 0 do h.host:undo() end
    draw_spine()
    expect.equal(#tails(), 1)
end)

test("symmetric: two tails at once, tie, profile, cut and handles too", function()
    begin(nil, { 0.75, 0.1, -0.1 })
    h.host:set{ symmetric = true }
    local before = h.scene:hash()
    h:drag({ at(0.075, 0.03, -0.03), at(0.11, 0.03, -0.05), at(0.14, -0.04, -0.06), at(0.15, -0.18, -0.06) },
        {}, 12)
    expect.equal(#tails(), 2)
    expect.equal(h:steps(), 1)
    draw_ring(h.world(tails()[1]:course()[4]), 0.017)
    draw_profile(0.03)
    local function alike(list, image)
        expect.equal(#list, #image)
        for i, point in ipairs(list) do
            local p, q = scalp:to_metres(point), scalp:to_metres(image[i])
            expect.near({ p[1], p[2], p[3] }, { -q[1], q[2], q[3] }, 1e-6)
        end
    end
    local function are_alike()
        alike(tails()[1]:points(), tails()[2]:points())
        alike(tails()[1]:section(), tails()[2]:section())
        alike(tails()[1]:profiles()[1], tails()[2]:profiles()[1])
    end
    are_alike()
    expect.truthy(#tails()[2]:section() > 5 and #tails()[2]:profiles()[1] > 5)
    local middle = pixel(tails()[1]:course()[math.floor(0.7 * #tails()[1]:course())])
    draw_pixels{ { middle[1] - 50, middle[2] + 4 }, { middle[1] + 50, middle[2] - 4 } }
    are_alike()
    h.host:set{ tightness = 0.8 }
    expect.near(tails()[2]:options().tightness, 0.8)
    h:press(h.world(tails()[1]:course()[6]))
    h.host:cancel()
    are_alike()
    h:key("delete")
    expect.equal(#tails(), 0)
    expect.equal(h:there_and_back(), before)
end)

test("g: streams gather hair into the tie, once; more of the hair is in it then", function()
    draw_spine()
    local function through_tie()
        local strands, count = h.scene:get("style hair"), 0
        local tie = tails()[1]:tie()
        for i = 1, #strands do
            local points, is_in = strands:strand(i), false
            for k = 1, #points, 3 do
                local off = vectors.plus({ points[k], points[k + 1], points[k + 2] }, tie.center, -1)
                is_in = is_in or vectors.length(off) < 1.6 * tie.radius
            end
            count = count + (is_in and 1 or 0)
        end
        return count / #strands
    end
    local alone = through_tie()
    h:key("g")
    local streams = hair.curves(hair.find(h.scene), "stream")
    expect.truthy(#streams >= 5 and #streams <= 8, #streams)
    for _, stream in ipairs(streams) do
        local points = stream:points()
        expect.truthy(vectors.length(vectors.plus(points[#points], tails()[1]:tie().center, -1)) < 0.03)
    end
    expect.equal(h:steps(), 2)
    local share = through_tie()
    expect.truthy(share > alone and share > 0.98, share .. " against " .. alone)
    local hash = h.scene:hash()
    h:key("g")
    expect.equal(#hair.curves(hair.find(h.scene), "stream"), #streams)
    h.host:undo()
    expect.equal(h.scene:hash(), hash)
    h:there_and_back()
end)

test("hair that misses the tie is told, until it is gathered", function()
    begin(nil, { 0.9, 0.05, 0 })
    h.host:set{ tightness = 0 }
    h:drag({ at(0, 0.09, -0.02), at(0, 0.13, -0.05), at(0, 0.15, -0.11), at(0, 0.06, -0.16),
        at(0, -0.06, -0.17) }, nil, 12)
    local share = require("tools.support.tail").share(hair.find(h.scene), h.scene:get("style hair"))
    expect.truthy(share < 0.85, share)
    expect.truthy(h.tool.advice.text:find("g gathers it", 1, true))
    h:key("g")
    expect.equal(h.tool.advice, nil)
    expect.truthy(require("tools.support.tail").share(hair.find(h.scene), h.scene:get("style hair")) > share)
end)

test("in profile a stroke away from the head is a tail in its middle; Alt: beside it, as seen", function()
    begin(nil, { 0.9, 0.05, -0.08 })
    local route = { at(0, 0.06, -0.07), at(0, 0.075, -0.13), at(0, 0.03, -0.17), at(0, -0.1, -0.19) }
    h:drag(route, {}, 12)
    local function off()
        local most = 0
        for _, point in ipairs(tails()[1]:points()) do
            most = math.max(most, math.abs(scalp:to_metres(point)[1]))
        end
        return most
    end
    expect.truthy(off() < 1e-6, off())
    expect.falsy(h.tool.advice)
    local height = head:nearest(tails()[1]:tie().center).distance / scalp:scale()
    expect.truthy(height > 0.015 and height < 0.03, height)
    h.host:undo()
    h:press(route[1])
    for i = 2, 4 do h:move(route[i]) end
    expect.truthy(h.host:draw().labels[1].text:find("tail in the middle  (Alt: tail)", 1, true))
    h:move(route[4], { alt = true })
    h:release(route[4])
    expect.truthy(off() > 0.01, off())
    expect.truthy(h.tool.advice.text:find("guess"))
    h.host:undo()
    -- A tail at the side of the head stays there.
    h:drag({ at(0.075, 0.03, -0.03), at(0.11, 0.02, -0.05), at(0.12, -0.03, -0.06) }, {}, 12)
    expect.truthy(off() > 0.06, off())
end)

test("a profile that begins beyond the tie leaves the tie where it is", function()
    draw_spine()
    local tie, course, points = tails()[1]:tie(), tails()[1]:course(), {}
    for i = math.floor(0.4 * #course), #course - 1 do
        points[#points + 1] = vectors.plus(h.world(course[i]), h.camera:right(), 0.03 * scalp:scale())
    end
    h:drag(points, {}, 4)
    expect.truthy(#tails()[1]:profiles()[1] > 3)
    expect.near(tails()[1]:tie().center, tie.center, 0.014)     -- half a step of the grid
    expect.near(tails()[1]:tie().radius, tie.radius, 0.004)
    h:there_and_back()
end)
