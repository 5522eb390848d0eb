-- Ponytails drawn by hand.
local hair = require "tools.support.hair"
local hand = require "hand"
local lissom = require "lissom"
local matrices = require "matrices"
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
    expect.truthy(not h.scene:get("style hair"))
    h:there_and_back()
end)

test("off the head, across the tail: refused with a reason, and nothing changes", function()
    local before = h.scene:hash()
    expect.error(function() h:drag{ at(0, 0.2, -0.3), at(0, 0, -0.3) } end, "")
    expect.equal(h.scene:hash(), before)
    draw_spine()
    before = h.scene:hash()
    expect.error(function() h:drag{ at(0, -0.06, -0.16), at(0, -0.06, -0.21) } end, "round it")
    expect.equal(h.scene:hash(), before)
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
    expect.error(function() h:press(at(0, 0.03, -0.085)) end, "no hairstyle")
    while h:steps() > 0 do h.host:undo() end
    draw_spine()
    expect.equal(#tails(), 1)
end)
