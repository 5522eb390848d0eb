-- Partings drawn by hand.
local hair = require "tools.support.hair"
local hand = require "hand"
local lissom = require "lissom"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"

local head = lissom.shapes.head{ vertices = 6000 }
local scalp = lissom.scalp(head)
local h, style

local function on_head(azimuth, elevation) return scalp:at{ azimuth = azimuth, elevation = elevation } end

-- A hand over a head, seen from above and in front; `place` is where the head stands.
local function begin(place)
    style = lissom.hairstyle(head, { scalp = scalp, resolution = 6000 })
    local function world(point) return place and matrices.point(place, point) or point end
    local at = scalp:center()
    h = hand.new("parting", { head = head, style = style }, {
        eye = world{ at[1], at[2] + 0.5, at[3] + 0.3 }, target = world(at), fov = 26,
        places = place and { head = place, style = place } or nil,
    })
    h.host:set{ strands = 200 }
    h.world = world
    h.scene:clear_history()
end

test.before(function() begin() end)

-- Drags over points of the head.
local function draw(places, options)
    local points = {}
    for i, place in ipairs(places) do points[i] = h.world(on_head(place[1], place[2])) end
    h:drag(points, options, 12)
end

local front_to_back = { { 0, 40 }, { 0, 55 }, { 0, 70 }, { 0, 85 } }

local function parting(number) return hair.curves(hair.find(h.scene), "dividing")[number or 1] end

test("a stroke is a parting, one step, with hair", function()
    local before = h.scene:hash()
    draw(front_to_back)
    expect.equal(h:steps(), 1)
    expect.equal(parting():name(), "parting")
    expect.equal(#h.scene:get("style hair"), 200)
    local first = parting():course()[1]
    expect.truthy(hair.distance({ first, first }, on_head(0, 40)) < 0.004)
    expect.near(parting():options().sigma, 0.014, 1e-12)
    expect.equal(h:there_and_back(), before)
    expect.equal(#h.host:draw().labels, 0)
end)

test("strokes beside it are its tilt; all of a side count, and undo takes one back", function()
    draw(front_to_back)
    draw{ { 12, 50 }, { 22, 60 }, { 36, 68 } }
    expect.equal(#style:curves(), 1)
    local one = parting():tilt()
    local side = one.left.pieces > 0 and "left" or "right"
    expect.truthy(one[side].pieces > 3 and one[side].start > 10)
    expect.equal(#parting():hints(), 1)
    draw{ { 25, 74 }, { 60, 70 } }
    expect.equal(#parting():hints(), 2)
    local both = parting():tilt()
    expect.truthy(both[side].pieces > one[side].pieces)
    h.host:undo()
    expect.equal(parting():tilt()[side].pieces, one[side].pieces)
    h.host:redo()
    expect.near(parting():tilt()[side].start, both[side].start, 0)
    expect.equal(h:steps(), 3)
    h:key("backspace")
    expect.equal(#parting():hints(), 0)
    expect.equal(parting():tilt()[side].start, 0)
    h:there_and_back()
end)

test("with shift, or away from it, a stroke is another parting; tab and a click choose", function()
    draw(front_to_back)
    draw({ { 25, 50 }, { 30, 65 }, { 45, 78 } }, { shift = true })
    draw{ { 70, 40 }, { 80, 50 }, { 100, 55 } }
    expect.equal(#style:curves(), 3)
    expect.truthy(h.tool.curve == parting(3))
    h:key("tab")
    expect.truthy(h.tool.curve == parting(1))
    h:click(h.world(parting(3):course()[2]))
    expect.truthy(h.tool.curve == parting(3))
    h:click(h.world(on_head(-60, 40)))
    expect.truthy(h.tool.curve == parting(3))
    h:key("delete")
    expect.equal(#style:curves(), 2)
    h:key("delete", "delete", "delete")
    expect.equal(#style:curves(), 0)
    expect.falsy(meshes.object(h.scene, "style hair"))
    h:there_and_back()
end)

test("its handles are dragged: how far off the crest is, and how high", function()
    draw(front_to_back)
    local steps = h:steps()
    local function handle(number) return h.host:draw().points[number].points[1] end
    local sigma, base = handle(1), parting():course()
    local middle = base[math.ceil(#base / 2)]
    local farther = {}
    for k = 1, 3 do farther[k] = sigma[k] + 0.8 * (sigma[k] - h.world(middle)[k]) end
    h:drag{ sigma, farther }
    expect.truthy(parting():options().sigma > 0.018 and parting():options().sigma < 0.03)
    expect.equal(h:steps(), steps + 1)
    expect.near(h.tool.params.sigma, 1000 * parting():options().sigma, 1e-9)
    expect.equal(#h.scene:get("style hair"), 200)
    local center = scalp:center()
    h.camera = lissom.camera{ eye = { center[1] + 0.2, center[2] + 0.1, center[3] + 0.7 }, target = center,
        fov = 26 }
    h.host:look(h.camera)
    for number, option in ipairs{ "height", "separation" } do
        local top, up = handle(number + 1), {}
        local value = parting():options()[option]
        for k = 1, 3 do up[k] = top[k] + 0.005 * h.camera:up()[k] end
        h:drag{ top, up }
        expect.truthy(parting():options()[option] > 1.2 * value)
    end
    expect.equal(h:steps(), steps + 3)
    h:there_and_back()
end)

test("the panel changes the chosen parting, and what is drawn next", function()
    draw(front_to_back)
    h.host:set{ separation = 0.7, gap = 6, sigma = 20 }
    local options = parting():options()
    expect.near({ options.separation, options.gap, options.sigma }, { 0.7, 0.006, 0.02 }, 1e-12)
    draw({ { 60, 40 }, { 70, 60 } }, { shift = true })
    expect.near(parting(2):options().gap, 0.006, 1e-12)
    h.host:set{ strands = 50 }
    expect.equal(#h.scene:get("style hair"), 50)
end)

test("what cannot be a parting is refused with a reason, and nothing changes", function()
    draw(front_to_back)
    local before = h.scene:hash()
    expect.error(function() draw{ { 0, -20 }, { 0, 40 } } end, "")
    expect.equal(h.scene:hash(), before)
    expect.error(function() h:drag{ { 5, 5, 0 }, { 5, 4, 0 } } end, "")
    expect.equal(h.scene:hash(), before)
    draw{ { 12, 50 }, { 40, 60 } }
    expect.equal(#parting():hints(), 1)
end)

test("on a head that stands elsewhere, turned and twice as large", function()
    begin{ { 0, 0, 2, 30 }, { 0, 2, 0, -7 }, { -2, 0, 0, 3 }, { 0, 0, 0, 1 } }
    h.camera = lissom.camera{ eye = h.world{ 0, 0.8, 0.5 }, target = h.world(scalp:center()), fov = 26 }
    h.host:look(h.camera)
    draw(front_to_back)
    local last = parting():course()
    expect.truthy(hair.distance({ last[#last], last[#last] }, on_head(0, 85)) < 0.006)
    draw{ { 12, 50 }, { 22, 60 }, { 36, 68 } }
    expect.equal(#parting():hints(), 1)
    expect.near(h.scene:info("style hair").transform[1][4], 30)
    h:there_and_back()
end)

test("the style goes, or there is none; Escape in the middle", function()
    h:press(on_head(0, 40))
    h:move(on_head(0, 60))
    h.host:cancel()
    h:release(on_head(0, 60))
    expect.equal(#style:curves(), 0)
    draw(front_to_back)
    h:press(on_head(60, 40))
    h.scene:remove("style")
    h:move(on_head(70, 60))
    h:release(on_head(70, 60))
    h:key("tab", "delete", "backspace")
    h.host:set{ gap = 3 }
    h.host:draw()
    h.scene:remove("head")
    expect.error(function() h:press(on_head(0, 40)) end, "no hairstyle")
    while h:steps() > 0 do h.host:undo() end
    draw(front_to_back)
    expect.equal(#style:curves(), 1)
end)

test("symmetric: a parting beside the middle has a mirror image, which does the same", function()
    h.host:set{ symmetric = true }
    draw(front_to_back)
    expect.equal(#style:curves(), 1)
    draw{ { 50, 35 }, { 65, 40 }, { 80, 38 } }
    expect.equal(#style:curves(), 3)
    draw{ { 58, 45 }, { 64, 52 }, { 70, 60 } }
    local a, b = parting(2), parting(3)
    expect.equal(#a:hints(), 1)
    expect.equal(#b:hints(), 1)
    local one, other = a:tilt(), b:tilt()
    expect.truthy(one.left.pieces > 0 or one.right.pieces > 0)
    expect.near({ one.left.start, one.left.finish }, { other.right.start, other.right.finish }, 2)
    h.host:set{ sigma = 22 }
    expect.near({ a:options().sigma, b:options().sigma }, { 0.022, 0.022 }, 1e-12)
    h:key("delete")
    expect.equal(#style:curves(), 1)
    h:there_and_back()
end)
