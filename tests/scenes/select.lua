-- Selecting by hand: every way, with shift and ctrl, by keys, and where there is nothing to select.
local hand = require "hand"
local lissom = require "lissom"

-- A square of 5 x 5 vertices of spacing .5 that looks at the camera.
local function sheet()
    return lissom.shapes.grid{ size = { 2, 2 }, segments = { 4, 4 } }
        :transform{ rotate = { axis = "x", angle = 90 } }
end

local function moved(x, y, z) return { { 1, 0, 0, x }, { 0, 1, 0, y }, { 0, 0, 1, z }, { 0, 0, 0, 1 } } end

local h

test.before(function()
    h = hand.new("select", { sheet = sheet() })
    h.host:set{ by = "click" }
end)

-- The selected vertices as a set of "x,y", in steps of the sheet from its middle.
local function places(name)
    local list, mesh = {}, h.scene:get(name or "sheet")
    for _, v in ipairs(h:selected(name or "sheet")) do
        local x, y = mesh:position(v)
        table.insert(list, string.format("%d,%d", math.floor(2 * x + 0.5), math.floor(2 * y + 0.5)))
    end
    table.sort(list)
    return table.concat(list, " ")
end

test("a click selects the vertex under the cursor, shift adds, ctrl removes, the void drops", function()
    local before = h.scene:hash()
    h:click{ 0.02, 0.01, 0 }
    expect.equal(places(), "0,0")
    h:click({ 0.5, 0, 0 }, { shift = true })
    expect.equal(places(), "0,0 1,0")
    h:click({ 0, 0, 0 }, { ctrl = true })
    expect.equal(places(), "1,0")
    h:click{ 3, 3, 0 }
    expect.equal(places(), "")
    expect.equal(h.scene:hash(), before)
    expect.equal(h:steps(), 4)
    expect.equal(h:there_and_back(), before)
end)

test("a click into the void where nothing is selected is no step", function()
    h:click{ 3, 3, 0 }
    h:click({ 3, 3, 0 }, { shift = true })
    expect.equal(h:steps(), 0)
end)

test("a brush selects what it comes over, in one step, also between events far apart", function()
    h.host:set{ by = "brush", radius = 20 }
    h:drag({ { -1, 0, 0 }, { 1, 0, 0 } }, nil, 1)
    expect.equal(places(), "-1,0 -2,0 0,0 1,0 2,0")
    expect.equal(h:steps(), 1)
    h:drag({ { 0, -1, 0 }, { 0, 1, 0 } }, { shift = true })
    expect.equal(#h:selected("sheet"), 9)
    h:drag({ { -1, 0, 0 }, { 1, 0, 0 } }, { ctrl = true })
    expect.equal(places(), "0,-1 0,-2 0,1 0,2")
    expect.equal(h:steps(), 3)
    h:there_and_back()
end)

test("a rectangle and a lasso, shown while they are drawn", function()
    h.host:set{ by = "rectangle" }
    h:press{ -0.7, 0.7, 0 }
    h:move{ 0.2, -0.2, 0 }
    expect.equal(#h.host:draw().outlines, 1)
    h:release{ 0.2, -0.2, 0 }
    expect.equal(places(), "-1,0 -1,1 0,0 0,1")
    expect.equal(#h.host:draw().outlines, 0)
    h.host:set{ by = "lasso" }
    h:drag({ { -0.2, -1.2, 0 }, { 0.2, -1.2, 0 }, { 0.2, 1.2, 0 }, { -0.2, 1.2, 0 } })
    expect.equal(places(), "0,-1 0,-2 0,0 0,1 0,2")
    h:click{ 0, 0, 0 }
    expect.equal(places(), "")
end)

test("a disk over the surface, from its middle to its rim", function()
    h.host:set{ by = "disk" }
    h:press{ 0, 0, 0 }
    expect.equal(places(), "0,0")
    h:move{ 0.5, 0, 0 }
    local disk = places()
    expect.truthy(disk:find("1,0", 1, true) and not disk:find("2", 1, true))
    h:move{ 4, 4, 0 }                   -- beside the surface it stays as it was
    h:release{ 4, 4, 0 }
    expect.equal(places(), disk)
    expect.equal(h:steps(), 1)
end)

test("components", function()
    local both = sheet():append(sheet():transform{ translate = { 3, 0, 0 } })
    h = hand.new("select", { both = both })
    h.host:set{ by = "component" }
    h:click{ 3, 0, 0 }
    expect.equal(#h:selected("both"), 25)
    h:click({ 0, 0, 0 }, { shift = true })
    expect.equal(#h:selected("both"), 50)
end)

test("keys grow, shrink, invert, select all and drop", function()
    h:click{ 0, 0, 0 }
    h:key("+")
    expect.equal(places(), "-1,0 0,-1 0,0 0,1 1,0")
    h:key("+", "-", "-")
    expect.equal(places(), "0,0")
    h:key("i")
    expect.equal(#h:selected("sheet"), 24)
    h:key("a")
    expect.equal(#h:selected("sheet"), 25)
    h:key("d")
    expect.equal(#h:selected("sheet"), 0)
    h:key("d", "q")
    h:key("a", "escape", "escape")
    expect.equal(#h:selected("sheet"), 0)
    expect.equal(h:steps(), 10)
    h:there_and_back()
end)

test("what the surface hides is selected only through it", function()
    h = hand.new("select", { box = lissom.shapes.box{} })
    h.host:set{ by = "rectangle" }
    h:drag{ { -1, -1, 0 }, { 1, 1, 0 } }
    expect.equal(#h:selected("box"), 4)
    h.host:set{ through = true }
    h:drag{ { -1, -1, 0 }, { 1, 1, 0 } }
    expect.equal(#h:selected("box"), 8)
end)

test("two meshes, one of them moved: each has a selection, and a new one drops the other", function()
    h = hand.new("select", { left = sheet(), right = sheet() }, { places = { right = moved(3, 0, 0) } })
    h.host:set{ by = "click" }
    h:click{ 0, 0, 0 }
    h:click{ 3.5, 0, 0 }
    expect.equal(places("left"), "")
    expect.equal(places("right"), "1,0")
    h:click({ 0, 0.5, 0 }, { shift = true })
    expect.equal(places("left"), "0,1")
    expect.equal(places("right"), "1,0")
    h.scene:set("right", { visible = false })
    h:key("a")
    expect.equal(places("right"), "1,0")
end)

test("Escape in the middle of a stroke leaves what was selected before", function()
    h.host:set{ by = "brush" }
    h:click{ 0, 0, 0 }
    local before = h.scene:hash()
    h:press{ -1, -1, 0 }
    h:move{ 1, -1, 0 }
    expect.truthy(#h:selected("sheet") > 1)
    h.host:cancel()
    expect.equal(h.scene:hash(), before)
    h:move{ 1, 1, 0 }
    h:release{ 1, 1, 0 }
    expect.equal(h.scene:hash(), before)
    expect.equal(h:steps(), 1)
end)

test("an object that goes, or whose faces change, under a stroke", function()
    h.host:set{ by = "brush" }
    h:press{ -1, -1, 0 }
    h.scene:remove("sheet")
    h:move{ 1, -1, 0 }
    h:release{ 1, -1, 0 }
    h:key("a", "+")
    expect.equal(#h.host:draw().outlines, 0)
end)

test("far from the origin and with 40,000 faces", function()
    local far = { 1e5, -1e5, 1e5 }
    local ball = lissom.shapes.sphere{ kind = "triangles", segments = 46 }:transform{ translate = far }
    h = hand.new("select", { ball = ball }, { eye = { 1e5, -1e5, 1e5 + 9 }, target = far, fov = 30 })
    h.host:set{ by = "disk" }
    h:drag{ { 1e5, -1e5, 1e5 + 1 }, { 1e5 + 0.5, -1e5, 1e5 + math.sqrt(0.75) } }
    local farthest = 0
    for _, v in ipairs(h:selected("ball")) do
        local x, y, z = ball:position(v)
        expect.truthy(z > 1e5)
        farthest = math.max(farthest, math.atan(math.sqrt((x - 1e5) ^ 2 + (y + 1e5) ^ 2), z - 1e5))
    end
    expect.near(farthest, math.asin(0.5), 0.03)
end)

test("disks of every radius are those of the distances, on a mesh of two parts as well", function()
    local disk = require "tools.support.disk"
    local mesh = lissom.shapes.cactus{ vertices = 2000 }
    mesh:append(lissom.shapes.box():transform{ translate = { 9, 0, 0 } })
    local middle, distances = 7, mesh:distances{ from = 7, method = "front" }
    local disks = disk.around(mesh, middle)
    for v = 1, #mesh, 19 do
        local radius = distances[v]
        local expected = mesh:region{ where = function(other) return distances[other] <= radius end }
        expect.equal(disks:up_to(v):vertices(), expected:vertices())
    end
    local corners = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }
    local triangle = lissom.mesh{ positions = corners, faces = { { 1, 2, 3 } } }
    expect.equal(#disk.around(triangle, 1):up_to(1), 1)
end)
