-- Bending by hand: handles from what is painted, the gizmo, typed numbers, and what may come in between.
local hand = require "hand"
local lissom = require "lissom"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"

-- Upright, five units long and one wide.
local function bar() return lissom.shapes.bar{ across = 4, along = 20 } end

local h

-- Paints the ends of an upright bar whose middle is at {x, y}, pins the lower one and makes a handle of the
-- upper one.
local function hold(x, y)
    x, y = x or 0, y or 0
    h:drag{ { x - 0.5, y - 2.4, 0.5 }, { x + 0.5, y - 2.4, 0.5 } }
    h:key("p")
    h:drag{ { x - 0.5, y + 2.4, 0.5 }, { x + 0.5, y + 2.4, 0.5 } }
    h:key("enter")
end

local function handles(name) return h.scene:get((name or "bar") .. " deformation"):handles() end

-- The middle of the vertices at the upper end, and of those at the lower one.
local function ends(name)
    local mesh = h.scene:get(name or "bar")
    return mesh:region("top"):center(), mesh:region("bottom"):center()
end

-- Drags the handle at a point by its part to the right.
local function drag_right(from, by)
    h:drag{ { from[1] + 0.6, from[2], 0 }, { from[1] + 0.6 + by, from[2], 0 } }
end

test.before(function()
    h = hand.new("deform", { bar = bar() })
    h.host:set{ radius = 25 }
end)

test("an end is painted, made a handle, and dragged: the surface follows, the other end stays", function()
    local rest = h.scene:hash()
    hold()
    expect.equal(#h:selected("bar"), 0)
    expect.equal(#handles(), 2)
    local at = handles()[2]:center()
    local steps = h:steps()
    drag_right(at, 1)
    expect.equal(h:steps(), steps + 1)
    expect.near(handles()[2]:center()[1], at[1] + 1, 1e-9)
    local up, down = ends()
    expect.truthy(up[1] > 0.9)
    expect.near(down, { 0, -2.5, 0 }, 0.05)
    expect.near({ h.scene:get("bar"):position(handles()[1]:region():vertices()[1]) },
        { bar():position(handles()[1]:region():vertices()[1]) })
    expect.equal(h:there_and_back(), rest)
end)

test("handles come back with undo, and can be dragged on", function()
    hold()
    local at = handles()[2]:center()
    drag_right(at, 1)
    local bent = h.scene:hash()
    h.host:undo()
    drag_right(at, 1)
    expect.equal(h.scene:hash(), bent)
    h.host:undo()
    h.host:undo()
    expect.equal(#handles(), 1)
    h:key("enter")
    drag_right(at, 1)
    expect.equal(h.scene:hash(), bent)
end)

test("what is drawn: handles, the gizmo, what is typed", function()
    hold()
    local drawn = h.host:draw()
    expect.equal(#drawn.regions, 2)
    local at = handles()[2]:center()
    h:move{ at[1] - 1, at[2] - 1, 0 }
    expect.equal(#h.host:draw().circles, 1)
    h:move{ at[1] + 0.6, at[2], 0 }                     -- over the gizmo a press does not paint
    expect.equal(#h.host:draw().circles, 0)
    h.host:type("12.5")
    expect.equal(h.host:draw().labels[1].text, "12.5")
    h:key("backspace")
    expect.equal(h.host:draw().labels[1].text, "12.")
    h.host:cancel()
    expect.equal(#h.host:draw().labels, 0)
end)

test("a number during a drag is exact, and the cursor does not count any more", function()
    hold()
    local at = handles()[2]:center()
    h:press{ at[1] + 0.6, at[2], 0 }
    h:move{ at[1] + 0.9, at[2], 0 }
    h.host:type("1.2")
    h:move{ at[1] + 3, at[2], 0 }
    h:release{ at[1] + 3, at[2], 0 }
    expect.near(handles()[2]:center()[1], at[1] + 1.2, 1e-9)
    h:there_and_back()
end)

test("a number after a drag replaces it; after undo it goes on from there", function()
    hold()
    local at = handles()[2]:center()
    drag_right(at, 0.7)
    h.host:type("2")
    h:key("enter")
    expect.near(handles()[2]:center()[1], at[1] + 2, 1e-9)
    h.host:type("-1.5")
    h:key("enter")
    expect.near(handles()[2]:center()[1], at[1] - 1.5, 1e-9)
    h.host:undo()
    h.host:undo()
    h.host:undo()
    expect.near(handles()[2]:center()[1], at[1], 1e-9)
    h.host:type("0.5")
    h:key("enter")
    expect.near(handles()[2]:center()[1], at[1] + 0.5, 1e-9)
    h:there_and_back()
end)

test("turns by a key, an axis and a number, also more than once around", function()
    hold()
    h:key("e", "y")
    h.host:type("450")
    h:key("enter")
    expect.near(handles()[2]:matrix().turn, { 0, 450, 0 }, 1e-6)
    h:key("e", "y")
    h.host:type("-90")
    h:key("enter")
    expect.near(handles()[2]:matrix().turn, { 0, 360, 0 }, 1e-6)
    h:there_and_back()
end)

test("scaling by a typed factor", function()
    hold()
    h:key("r")
    h.host:type("2")
    h:key("enter")
    expect.near(handles()[2]:matrix()[1][1], 2, 1e-9)
    expect.truthy(h.scene:get("bar"):region("top"):bounds().max[1] > 0.9)
end)

test("Escape in the middle of a drag, and of a number", function()
    hold()
    local at, before = handles()[2]:center(), h.scene:hash()
    h:press{ at[1] + 0.6, at[2], 0 }
    h:move{ at[1] + 2, at[2], 0 }
    expect.truthy(h.scene:hash() ~= before)
    h.host:cancel()
    expect.equal(h.scene:hash(), before)
    h:release{ at[1] + 2, at[2], 0 }
    expect.equal(h.scene:hash(), before)
    h.host:type("3")
    h.host:cancel()
    drag_right(at, 1)
    expect.near(handles()[2]:center()[1], at[1] + 1, 1e-9)
end)

test("undo and another tool in the middle of a drag", function()
    hold()
    local at, before = handles()[2]:center(), h.scene:hash()
    h:press{ at[1] + 0.6, at[2], 0 }
    h:move{ at[1] + 2, at[2], 0 }
    h.host:use(lissom.load_tool("select"))
    expect.equal(h.scene:hash(), before)
    h.host:use(h.tool)
    h:press{ at[1] + 0.6, at[2], 0 }
    h:move{ at[1] + 2, at[2], 0 }
    h.host:undo()
    h:release{ at[1] + 2, at[2], 0 }
    drag_right(handles()[#handles()]:center(), 0.5)
    h:there_and_back()
end)

test("the object or its deformation goes in the middle of a drag", function()
    hold()
    local at = handles()[2]:center()
    for _, name in ipairs{ "bar", "bar deformation" } do
        h:press{ at[1] + 0.6, at[2], 0 }
        h.scene:remove(name)
        h:move{ at[1] + 1, at[2], 0 }
        h:release{ at[1] + 1, at[2], 0 }
        h:key("tab", "delete", "f", "w")
        h.host:draw()
        h.host:undo()
        expect.equal(#handles(), 2)
    end
    drag_right(at, 1)
    expect.near(handles()[2]:center()[1], at[1] + 1, 1e-9)
end)

test("where nothing is selected Enter says what to do, and a press into the void is nothing", function()
    expect.error(function() h:key("enter") end, "nothing is selected")
    h:drag{ { 4, 4, 0 }, { 3, 3, 0 } }
    expect.equal(h:steps(), 0)
    h:key("tab", "delete", "f", "w", "x")
    expect.equal(h:steps(), 0)
end)

test("a handle alone moves all of its part, and no other part of the mesh", function()
    local both = bar():append(bar():transform{ translate = { 3, 0, 0 } })
    h = hand.new("deform", { both = both })
    h:drag{ { -0.5, 2.4, 0.5 }, { 0.5, 2.4, 0.5 } }
    h:key("enter")
    expect.equal(#h.scene:get("both deformation"):region(), #both // 2)
    h:key("x")
    h.host:type("-1")
    h:key("enter")
    expect.near(both:bounds().min[1], -1.5, 1e-6)
    expect.near(both:bounds().max[1], 3.5, 1e-12)
end)

test("specks that the brush has caught are no part of a handle, few vertices are", function()
    local mesh = lissom.shapes.bar{ across = 12, along = 60 }
    h = hand.new("deform", { bar = mesh })
    local blob = mesh:region{ box = { min = { nil, 1.5, nil } } }
    local speck = mesh:region{ vertices = { mesh:nearest(0.5, -2, 0).vertex } }
    expect.truthy(#blob > 101)
    mesh:set_region("selected", blob:union(speck))
    h:key("enter")
    expect.equal(#handles()[1]:region(), #blob)
    mesh:set_region("selected", speck)
    h:key("p")
    expect.equal(#handles()[2]:region(), 1)
end)

test("reach keeps the rest of the surface where it is", function()
    h.host:set{ reach = 0.6 }
    h:drag{ { -0.5, 2.4, 0.5 }, { 0.5, 2.4, 0.5 } }
    h:key("enter")
    local rest = bar()
    h:key("x")
    h.host:type("0.5")
    h:key("enter")
    local mesh, moved = h.scene:get("bar"), 0
    for v = 1, #rest do
        local x = mesh:position(v)
        if x ~= rest:position(v) then moved = moved + 1 end
    end
    expect.truthy(moved > 0 and moved <= #h.scene:get("bar deformation"):region())
    expect.truthy(moved < #rest / 2)
end)

test("a soft handle lags behind", function()
    hold()
    h:key("delete")
    h.host:set{ softness = 5 }
    h:drag{ { -0.5, 2.4, 0.5 }, { 0.5, 2.4, 0.5 } }
    h:key("enter", "y")
    h.host:type("1")
    h:key("enter")
    local up = ends()
    expect.truthy(up[2] > 2.5 and up[2] < 3.45)
end)

test("mirrored handles move against each other, also in a mesh that is away from the origin", function()
    local wide = bar():transform{ rotate = { axis = "z", angle = 90 }, translate = { 1, 0, 0 } }
    h = hand.new("deform", { wide = wide })
    h:drag{ { 1, -0.5, 0.5 }, { 1, 0.5, 0.5 } }
    h:key("p")
    h.host:set{ mirror = "x" }
    h:drag{ { 3.4, -0.4, 0.5 }, { 3.4, 0.4, 0.5 } }
    h:key("enter")
    expect.equal(#handles("wide"), 3)
    h:key("x")
    h.host:type("0.5")
    h:key("enter")
    local box = wide:bounds()
    expect.near(box.center[1], 1, 1e-3)
    expect.truthy(box.max[1] - box.min[1] > 5.9)
    h:there_and_back()
end)

test("a mirror image is found on a side with other vertices; the label says how well they match", function()
    local wide = bar():transform{ rotate = { axis = "z", angle = 90 } }
    wide = wide:subdivide{ region = wide:region{ box = { min = { -9, -9, -9 }, max = { 0, 9, 9 } } } }
    h = hand.new("deform", { wide = wide })
    h.host:set{ mirror = "x" }
    h:drag{ { 2.4, -0.4, 0.5 }, { 2.4, 0.4, 0.5 } }
    h:key("enter")
    expect.equal(#handles("wide"), 2)
    expect.truthy(h.host:draw().labels[1].text:find("^mirrored; the sides differ by 0%.?%d* %% of the size"))
    h:key("x")
    h.host:type("0.5")
    h:key("enter")
    local box = wide:bounds()
    expect.near(box.center[1], 0, 0.01)
    expect.truthy(box.max[1] - box.min[1] > 5.9)
    h:there_and_back()
end)

test("a press on the vertices of a handle chooses it, with shift it paints", function()
    hold()
    local low = handles()[1]:center()
    local steps = h:steps()
    h:click{ 0.3, -2.4, 0.5 }
    expect.equal(h:steps(), steps)
    drag_right(low, 0.5)
    expect.near(handles()[1]:center()[1], low[1] + 0.5, 1e-9)
    h:click({ 0.3, 2.4, 0.5 }, { shift = true })
    expect.truthy(#h:selected("bar") > 0)
end)

test("a deformation that a script has added without its mesh: f leaves the mesh in its place", function()
    local mesh = bar()
    local deformer = lissom.deformer(mesh)
    deformer:add_handle(mesh:region("bottom"))
    local top = deformer:add_handle(mesh:region("top"))
    local place = { { 1, 0, 0, 0 }, { 0, 1, 0, 1 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } }
    h = hand.new("deform", { bend = deformer }, { places = { bend = place } })
    drag_right({ 0, 3.5, 0 }, 1)
    expect.near(top:center()[1], 1, 1e-9)
    local bent = mesh:hash()
    h:key("f")
    expect.equal(h.scene:info("bend").kind, "mesh")
    expect.equal(h.scene:info("bend").transform, place)
    expect.equal(h.scene:get("bend"):hash(), bent)
    h:there_and_back()
    h.host:undo()
    h:key("delete", "delete")
    expect.equal(h.scene:info("bend").kind, "mesh")
end)

test("a pinned part has no gizmo until it is clicked", function()
    h:drag{ { -0.5, -2.4, 0.5 }, { 0.5, -2.4, 0.5 } }
    h:key("p")
    local at = handles()[1]:center()
    drag_right(at, 1)
    expect.near(handles()[1]:center(), at)
    h:click{ at[1], at[2], 0.5 }
    drag_right(at, 1)
    expect.near(handles()[1]:center()[1], at[1] + 1, 1e-9)
end)

test("tab and clicks choose the handle, delete takes it away, f ends it with its shape", function()
    hold()
    local low, high = handles()[1]:center(), handles()[2]:center()
    h:key("tab", "x")
    h.host:type("1")
    h:key("enter")
    expect.near(handles()[1]:center()[1], low[1] + 1, 1e-9)
    h:click(high)
    drag_right(high, -1)
    expect.near(handles()[2]:center()[1], high[1] - 1, 1e-9)
    local shape = h.scene:get("bar"):copy()
    shape:remove_region("pinned")
    h:key("f")
    expect.equal(h.scene:get("bar"):hash(), shape:hash())
    expect.equal(#h.scene, 1)
    h.host:undo()
    h:key("delete", "delete")
    expect.equal(#h.scene, 1)
    h:there_and_back()
end)

test("an object that stands turned, scaled and mirrored: the gizmo moves in the world", function()
    local place = { { 0, 2, 0, 1 }, { 2, 0, 0, 0 }, { 0, 0, 2, 0 }, { 0, 0, 0, 1 } }
    h = hand.new("deform", { bar = bar() }, { places = { bar = place }, ortho = 19.2 })
    -- The bar lies along x, from -4 to 6; a hundred pixels are two units.
    h:drag{ { -3.8, -1, 1 }, { -3.8, 1, 1 } }
    h:key("p")
    h:drag{ { 5.8, -1, 1 }, { 5.8, 1, 1 } }
    h:key("enter")
    local function at() return matrices.point(place, handles()[2]:center()) end
    local before = at()
    h:key("y")
    h.host:type("1.5")
    h:key("enter")
    expect.near(at(), { before[1], before[2] + 1.5, before[3] }, 1e-9)
    h:key("e", "z")
    h.host:type("450")
    h:key("enter")
    expect.near(handles()[2]:matrix().turn[3], -450, 1e-6)
    h:there_and_back()
end)

test("two meshes with handles of their own", function()
    h = hand.new("deform", {
        left = bar():transform{ translate = { -2, 0, 0 } },
        right = bar():transform{ translate = { 2, 0, 0 } },
    })
    hold(-2)
    hold(2)
    expect.equal(#handles("left"), 2)
    expect.equal(#handles("right"), 2)
    local still = h.scene:get("right"):hash()
    local at = handles("left")[2]:center()
    h:click(at)
    drag_right(at, 0.5)
    expect.near(handles("left")[2]:center()[1], at[1] + 0.5, 1e-9)
    expect.equal(h.scene:get("right"):hash(), still)
    h:there_and_back()
end)

test("a deformation of faces that are no more is passed over, and another can begin", function()
    hold()
    h.scene:step("triangulate", function() h.scene:get("bar"):triangulate() end)
    h.host:draw()
    h:key("delete", "w")
    hold()
    expect.equal(#h.scene:get("bar deformation 2"):handles(), 2)
end)

test("with open boundaries, far from the origin, and 40,000 faces", function()
    local far = 1e5
    local tube = lissom.shapes.cylinder{
        segments = 200, rings = 200, radius = 0.5, height = 5, caps = false,
    }
    tube:transform{ translate = { far, far, -far } }
    h = hand.new("deform", { tube = tube },
        { eye = { far, far, -far + 50 }, target = { far, far, -far } })
    h:drag{ { far - 0.5, far - 2.4, -far }, { far + 0.5, far - 2.4, -far } }
    h:key("p")
    h:drag{ { far - 0.5, far + 2.4, -far }, { far + 0.5, far + 2.4, -far } }
    h:key("enter")
    expect.truthy(tube:face_count() >= 40000)
    local at = handles("tube")[2]:center()
    h:drag{ { at[1] + 0.6, at[2], -far }, { at[1] + 1.6, at[2], -far } }
    expect.near(handles("tube")[2]:center()[1], at[1] + 1, 1e-6)
    expect.near(tube:bounds().min[2], far - 2.5, 0.01)
end)

test("what is pinned stays so in a saved scene, until it is taken away or the work is finished", function()
    local support = require "tools.support.handles"
    local function pins(scene)
        local numbers = {}
        for i, one in ipairs(support.list(scene)) do
            if one.pinned then table.insert(numbers, i) end
        end
        return numbers
    end
    hold()
    expect.equal(pins(h.scene), { 1 })
    local file = test.file("pinned.lissom")
    h.scene:save(file)
    local loaded = assert(lissom.load_scene(file))
    expect.equal(pins(loaded), { 1 })
    expect.equal(#support.list(loaded), 2)
    support.remove(loaded, support.list(loaded)[1])
    expect.equal(pins(loaded), {})
    h:key("f")
    expect.equal(meshes.region(h.scene:get("bar"), "pinned"), nil)
end)

test("a pivot can be set, and turns are about it", function()
    hold()
    local before = handles()[2]:center()
    -- At the surface under the cursor.
    h:move{ 0, 0, 0.5 }
    h:key("v")
    h.host:draw()
    local pivot = h.tool.grip.gizmo:origin()
    expect.near(pivot[1], 0, 0.02)
    expect.near(pivot[2], 0, 0.02)
    h:key("e")
    h:key("z")
    h.host:type("90"):key{ key = "enter" }
    local after = handles()[2]:center()
    expect.near(after[1], -before[2], 0.05)
    expect.near(after[2], 0, 0.05)
    -- At the middle of what is selected; beside the surface the handle's own again.
    h:drag{ { -0.5, -1, 0.5 }, { 0.5, -1, 0.5 } }
    h:key("v")
    h.host:draw()
    expect.near(h.tool.grip.gizmo:origin()[2], -1, 0.3)
    expect.equal(meshes.region(h.scene:get("bar"), "selected"), nil)
    h:move{ 4, 4, 0 }
    h:key("v")
    h.host:draw()
    expect.near(h.tool.grip.gizmo:origin()[1], after[1], 1e-9)
end)

test("the brush takes the nearest surface, or with 'through' all that it covers", function()
    local function depths()
        local mesh, front, back = h.scene:get("bar"), 0, 0
        for _, v in ipairs(mesh:region("selected"):vertices()) do
            local _, _, z = mesh:position(v)
            if z > 0.4 then front = front + 1 end
            if z < -0.4 then back = back + 1 end
        end
        return front, back
    end
    h:drag{ { -0.2, 1, 0.5 }, { 0.2, 1, 0.5 } }
    local front, back = depths()
    expect.truthy(front > 0)
    expect.equal(back, 0)
    h.host:set{ through = true }
    h:drag{ { -0.2, 1, 0.5 }, { 0.2, 1, 0.5 } }
    local all_front, all_back = depths()
    expect.equal(all_front, front)
    expect.truthy(all_back > 0)
    h:key("enter")
    expect.truthy(#handles()[1]:region() >= all_front + all_back)
end)

test("faces that run through one another are drawn if that is asked for, also after undo", function()
    hold()
    local function drawn() return #h.host:draw().regions - 2 end
    local deformer = h.scene:get("bar deformation")
    handles()[2]:set{ rotate = { axis = "z", angle = 160 }, translate = { 0.3, -4.2, 0 } }
    deformer:solve()
    expect.truthy(#deformer:contacts() > 0)
    expect.equal(drawn(), 0)
    h.host:set{ contacts = true }
    expect.equal(drawn(), 1)
    expect.equal(#h.tool.contacts.region, #deformer:contacts().region)
    handles()[2]:reset()
    deformer:solve()
    expect.equal(drawn(), 0)
    drag_right(handles()[2]:center(), 1)
    expect.equal(drawn(), 0)
    h.host:undo()
    expect.equal(drawn(), 0)
end)

test("pinholes of a handle are closed, larger holes and other parts are not", function()
    local support = require "tools.support.meshes"
    local grid = lissom.shapes.grid{ segments = 20 }
    local all = grid:region{ all = true }
    local function around(vertex, rings) return grid:region{ vertices = { vertex } }:grow(rings) end
    local middle = math.floor(grid:vertex_count() / 2)
    local pinhole = around(middle, 1)
    expect.truthy(#pinhole <= 10)
    expect.equal(#support.without_pinholes(all:minus(pinhole)), #all)
    local hole = around(middle, 3)
    expect.truthy(#hole > 10)
    expect.equal(#support.without_pinholes(all:minus(hole)), #all - #hole)
end)

test("the axis that a key has chosen lights up, and a typed number is shown at once", function()
    hold()
    local function lit()
        local count = 0
        for _, line in ipairs(h.host:draw().lines) do
            if line.color == "#ffd24a" then count = count + 1 end
        end
        return count
    end
    h:move{ 4, 4, 0 }
    expect.equal(lit(), 0)
    h:key("x")
    expect.truthy(lit() > 0)
    h.host:type("1")
    expect.equal(h.host:draw().labels[1].text, "1")
end)
