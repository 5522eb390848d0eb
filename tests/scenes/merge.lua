-- Merging by hand: two loops, keys, a transition, and what may come in between.
local hand = require "hand"
local lissom = require "lissom"

-- A cup that is open to the right, and a larger one to the right of it that is open to the left. Seen from in
-- front, at x = -2 and x = 2.
local function cup(direction, x, radius, segments)
    local ball = lissom.shapes.sphere{ kind = "triangles", segments = segments }
    local half = ball:cut{ plane = { point = { 0.02 * direction, 0, 0 }, normal = { -direction, 0, 0 } } }
    return half:transform{ scale = radius, translate = { x, 0, 0 } }
end

local h

local function new(options)
    options = options or {}
    h = hand.new("merge", { small = cup(1, -2, 1, 10), large = cup(-1, 2, 1.5, 12) },
        { eye = options.eye or { 0, 0, 50 }, ortho = options.ortho or 19.2, places = options.places })
end

-- A point of the loop of one of the cups, at an angle from the nearest point upwards.
local function on(name, angle)
    local x, radius = name == "small" and -2 or 2, name == "small" and 1 or 1.5
    local a = math.rad(angle)
    return { x, radius * math.sin(a), radius * math.cos(a) }
end

local function click_loops()
    h:click(on("small", 20))
    h:click(on("large", 20))
end

test.before(function() new() end)

test("two loops are clicked: the result stands for the second mesh; Enter hides the first too", function()
    local before = h.scene:hash()
    expect.truthy(h.host:prompt():find("moved", 1, true))
    click_loops()
    local mesh = h.scene:get("merged")
    expect.truthy(mesh:is_closed())
    expect.equal(mesh:components(), 1)
    expect.near(mesh:bounds().max[1], h.scene:get("large"):bounds().max[1])
    expect.equal(h.scene:info("large").visible, false)
    expect.equal(h.scene:info("small").visible, true)
    expect.equal(#h.host:draw().lines, 2)
    h:key("enter")
    expect.equal(h.scene:info("small").visible, false)
    expect.equal(#h.host:draw().lines, 0)
    expect.equal(h:there_and_back(), before)
end)

test("keys: pairs of points that meet turn the part", function()
    click_loops()
    local free = h.scene:get("merged"):hash()
    h:click(on("small", 0))
    expect.equal(#h.host:draw().labels, 2)
    h:click(on("large", 60))
    local keyed = h.scene:get("merged")
    expect.truthy(keyed:hash() ~= free)
    expect.truthy(keyed:is_closed())
    expect.equal(#h.host:draw().labels, 3)
    h:click(on("small", -60))
    h:click(on("large", -10))
    expect.truthy(h.scene:get("merged"):is_closed())
    h:key("enter")
    h:there_and_back()
end)

test("the result is that of lissom.merge", function()
    click_loops()
    local small_mesh, large_mesh = h.scene:get("small"), h.scene:get("large")
    local mesh, report = lissom.merge{
        joins = { { source = small_mesh:boundaries()[1], target = large_mesh:boundaries()[1] } },
    }
    expect.equal(h.scene:get("merged"):hash(), mesh:set_region("seam", report.seam.region):hash())
end)

-- A cup with a spike at an angle from the nearest point upwards, and where the spike of a mesh is.
local function spiked(direction, x, radius, segments, angle)
    local mesh = cup(direction, x, radius, segments)
    local a = math.rad(angle)
    local from = { x - 0.5 * direction * radius, 0.8 * radius * math.sin(a), 0.8 * radius * math.cos(a) }
    local v = mesh:nearest(from[1], from[2], from[3]).vertex or mesh:region{ sphere = { center = from,
        radius = 0.3 * radius } }:vertices()[1]
    mesh:set_position(v, from[1], 2 * from[2], 2 * from[3])
    return mesh, v
end

test("the wheel turns the part, by five degrees a line, and the label says how it was placed", function()
    local small, spike = spiked(1, -2, 1, 16, 0)
    h = hand.new("merge", { small = small, large = cup(-1, 2, 1.5, 24) }, { ortho = 19.2 })
    click_loops()
    local function spike_angle()
        local mesh, best, most = h.scene:get("merged"), nil, 0
        for v = 1, #mesh do
            local x, y, z = mesh:position(v)
            local r = x < 2 and math.sqrt(y * y + z * z) or 0
            if r > most then best, most = math.deg(math.atan(y, z)), r end
        end
        return best
    end
    local rest = math.deg(math.atan(select(2, small:position(spike)), (select(3, small:position(spike)))))
    expect.near(spike_angle(), rest, 2)
    local label = h.host:draw().labels[1].text
    expect.truthy(label:find("placed: as placed", 1, true) and label:find("good: ", 1, true))
    h.host:wheel{ x = 640, y = 480, lines = 6, ctrl = true }
    label = h.host:draw().labels[1].text
    expect.truthy(label:find("turned by 30 degrees", 1, true))
    expect.near(math.abs(spike_angle() - rest), 30, 3)
    h.host:wheel{ x = 640, y = 480, lines = -6, ctrl = true }
    expect.near(spike_angle(), rest, 2)
    h.host:set{ place = "shape" }
    expect.truthy(h.host:draw().labels[1].text:find("placed: shape", 1, true))
    h.host:set{ place = "as placed" }
    h:key("enter")
    h:there_and_back()
end)

test("hints: up and front of the part go to those of the other mesh, arrows show them", function()
    local a = math.rad(60)
    local place = { { 1, 0, 0, 0 }, { 0, math.cos(a), -math.sin(a), 0 }, { 0, math.sin(a), math.cos(a), 0 },
        { 0, 0, 0, 1 } }
    -- The spike is up in the mesh and leans by 60 degrees in the scene, towards the eye.
    local small = spiked(1, -2, 1, 16, 90)
    h = hand.new("merge", { small = small, large = cup(-1, 2, 1.5, 24) },
        { ortho = 19.2, places = { small = place } })
    click_loops()
    local function spike_angle()
        local mesh, best, most = h.scene:get("merged"), nil, 0
        for v = 1, #mesh do
            local x, y, z = mesh:position(v)
            local r = x < 2 and math.sqrt(y * y + z * z) or 0
            if r > most then best, most = math.deg(math.atan(y, z)), r end
        end
        return best
    end
    local leaning = spike_angle()
    local lines = #h.host:draw().lines
    h.host:set{ part_up = "z" }
    expect.near(spike_angle(), leaning, 3)
    expect.equal(#h.host:draw().lines, lines + 2)
    expect.truthy(h.host:draw().labels[1].text == "up")
    h.host:set{ up = "y" }
    expect.near(spike_angle(), leaning + 90, 3)
    h.host:set{ part_up = "none", up = "the same", part_front = "y", front = "z" }
    expect.near(spike_angle(), leaning - 90, 3)
    h.host:set{ part_front = "none", front = "the same" }
    expect.near(spike_angle(), leaning, 3)
    h:key("enter")
    h:there_and_back()
end)

test("the arrow of a hint is dragged to another direction, which undo takes back", function()
    h = hand.new("merge", { small = spiked(1, -2, 1, 16, 90), large = cup(-1, 2, 1.5, 24) }, { ortho = 19.2 })
    click_loops()
    h.host:set{ part_up = "y" }
    local function lines() return h.host:draw().lines end
    local function tip(k)
        local list = lines()
        return list[#list - k].points[2]
    end
    local function spike()
        local mesh, best, most = h.scene:get("merged"), nil, 0
        for v = 1, #mesh do
            local x, y, z = mesh:position(v)
            local r = x < 2 and math.sqrt(y * y + z * z) or 0
            if r > most then best, most = math.deg(math.atan(y, z)), r end
        end
        return best
    end
    local before, hash = spike(), h.scene:hash()
    local from = tip(1)             -- of the other mesh, whose loop is drawn last
    h:drag({ from, { from[1], from[2] - 9, from[3] } }, { ctrl = true })
    expect.near(tip(1)[2], -from[2], 1e-3)
    expect.near(math.abs(spike() - before), 180, 3)
    h.host:undo()
    expect.equal(h.scene:hash(), hash)
    expect.near(tip(1)[2], from[2], 1e-9)
    h.host:redo()
    h:key("enter")
    h:there_and_back()
end)

test("as placed goes by how the parts lie in the scene", function()
    local a = math.rad(40)
    local turned = { { 1, 0, 0, 0 }, { 0, math.cos(a), -math.sin(a), 0 }, { 0, math.sin(a), math.cos(a), 0 },
        { 0, 0, 0, 1 } }
    local small = spiked(1, -2, 1, 16, 0)
    local function merged(objects, places)
        h = hand.new("merge", objects, { ortho = 19.2, places = places })
        click_loops()
        return h.scene:get("merged")
    end
    local large = cup(-1, 2, 1.5, 24)
    local by_place = merged({ small = small, large = large }, { small = turned })
    local by_mesh = merged({ small = small:copy():transform{ rotate = { axis = "x", angle = 40 } },
        large = large })
    expect.equal(#by_place, #by_mesh)
    local p, q = by_place:positions(), by_mesh:positions()
    for i = 1, #p do expect.near(p[i], q[i], 1e-9) end
end)

test("the transition may be changed, before and after the result is taken", function()
    click_loops()
    local plain = h.scene:get("merged"):hash()
    h.host:set{ transition = 0.5 }
    local soft = h.scene:get("merged"):hash()
    expect.truthy(soft ~= plain)
    h.host:set{ transition = 0 }
    expect.equal(h.scene:get("merged"):hash(), plain)
    h:key("enter")
    h.host:set{ transition = 0.5 }
    expect.equal(h.scene:get("merged"):hash(), soft)
    expect.equal(h.scene:info("small").visible, false)
    h:there_and_back()
end)

test("undo in the middle: keys go on from those of before", function()
    click_loops()
    local free = h.scene:get("merged"):hash()
    h:click(on("small", 0))
    h:click(on("large", 60))
    h.host:undo()
    expect.equal(h.scene:get("merged"):hash(), free)
    expect.equal(#h.host:draw().labels, 1)
    h.host:set{ transition = 0.5 }
    h.host:set{ transition = 0 }
    expect.equal(h.scene:get("merged"):hash(), free)
    h:click(on("small", 0))
    h.host:undo()
    h:click(on("small", 0))
    h:click(on("large", 30))
    h:key("enter")
    expect.equal(h.scene:info("small").visible, false)
    h.host:undo()
    expect.equal(#h.host:draw().labels, 3)
    h:key("enter")
    expect.equal(h.scene:info("small").visible, false)
end)

test("clicks beside loops are none, and Enter before there is a result changes nothing", function()
    h:key("enter")
    h:click{ 0, 4, 0 }
    h:click{ -2.5, 0, 0.9 }
    h:key("enter")
    expect.equal(h:steps(), 0)
    expect.equal(#h.scene, 2)
    h:click(on("small", 20))
    h:key("enter")
    expect.equal(#h.scene, 2)
    h:click(on("large", 20))
    expect.equal(#h.scene, 3)
end)

test("Escape begins again, and takes away what was not taken", function()
    local before = h.scene:hash()
    h:click(on("small", 20))
    h.host:cancel()
    expect.truthy(h.host:prompt():find("moved", 1, true))
    click_loops()
    h:click(on("small", 0))
    h.host:cancel()
    expect.equal(h.scene:hash(), before)
    click_loops()
    h:key("enter")
    expect.equal(#h.scene, 3)
end)

test("another tool in the middle", function()
    h:click(on("small", 20))
    h.host:use(lissom.load_tool("select"))
    h.host:use(h.tool)
    click_loops()
    expect.equal(#h.scene, 3)
end)

test("a part goes in the middle: that is told, and the clicks begin again", function()
    h:click(on("small", 20))
    h.scene:remove("small")
    h:click(on("large", 20))
    expect.equal(h.host:draw().labels[1].text, "small is no longer there")
    expect.equal(#h.scene, 1)
    h.host:undo()
    click_loops()
    expect.equal(#h.host:draw().labels, 1)
    h:key("enter")
    expect.truthy(h.scene:get("merged"):is_closed())
end)

test("deformations are merged as their meshes", function()
    local small, large = cup(1, -2, 1, 10), cup(-1, 2, 1.5, 12)
    h = hand.new("merge", { small = lissom.deformer(small), large = lissom.deformer(large) },
        { ortho = 19.2 })
    click_loops()
    h:key("enter")
    expect.truthy(h.scene:get("merged"):is_closed())
    expect.equal(h.scene:info("small").visible, false)
end)

test("both loops of one mesh are joined by a bridge", function()
    local tube = lissom.shapes.cylinder{ caps = false, radius = 1, height = 4 }
    h = hand.new("merge", { tube = tube:transform{ rotate = { axis = "x", angle = 20 } } })
    local loops = h.scene:get("tube"):boundaries()
    local function near(loop) return loop:nearest(0, 0, 50).position end
    h:click(near(loops[1]))
    h:click(near(loops[2]))
    local ring = h.scene:get("merged")
    expect.truthy(ring:is_closed())
    expect.equal(ring:genus(), 1)
    expect.equal(#ring, #h.scene:get("tube"))
end)

test("keys that contradict each other are told, and the result before stays", function()
    click_loops()
    h:click(on("small", 0))
    h:click(on("large", 0))
    local one_key = h.scene:hash()
    h:click(on("small", 0))
    h:click(on("large", 60))
    expect.equal(h.scene:hash(), one_key)
    expect.truthy(#h.host:draw().labels[1].text > 10)
    h:click(on("small", 60))
    h:click(on("large", 60))
    expect.equal(#h.host:draw().labels, 5)
    h:key("enter")
    expect.equal(h.scene:info("small").visible, false)
end)

test("objects that stand elsewhere, turned and scaled: the result is where the second one is", function()
    local far = 1e5
    local function placed(scale)
        return { { scale, 0, 0, far }, { 0, scale, 0, far }, { 0, 0, scale, far }, { 0, 0, 0, 1 } }
    end
    h = hand.new("merge", { small = cup(1, -2, 1, 10), large = cup(-1, 2, 1.5, 12) },
        { eye = { far, far, far + 50 }, target = { far, far, far }, ortho = 19.2,
            places = { small = placed(0.5), large = placed(1) } })
    h:click{ far - 1, far, far + 0.5 }
    h:click{ far + 2, far, far + 1.5 }
    h:click{ far - 1, far + 0.5 * math.sin(1), far + 0.5 * math.cos(1) }
    h:click{ far + 2, far + 1.5 * math.sin(1), far + 1.5 * math.cos(1) }
    h:key("enter")
    expect.equal(h.scene:info("merged").transform, placed(1))
    expect.near(h.scene:get("merged"):bounds().max[1], h.scene:get("large"):bounds().max[1], 1e-9)
end)

test("40,000 faces", function()
    h = hand.new("merge", { small = cup(1, -2, 1, 40), large = cup(-1, 2, 1.5, 56) }, { ortho = 19.2 })
    click_loops()
    h:key("enter")
    expect.truthy(h.scene:get("merged"):face_count() > 40000)
    expect.truthy(h.scene:get("merged"):is_closed())
end)
