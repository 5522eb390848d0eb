-- Bones by hand: chains along a stroke or by clicks, and limbs bent by their tips, bones and bases.
local hand = require "hand"
local lissom = require "lissom"

-- Upright, five units long and one wide.
local function bar() return lissom.shapes.bar{ across = 4, along = 30 } end

local h

local function deformer(name) return h.scene:get((name or "bar") .. " deformation") end
local function chain() return deformer():bones()[1] end

-- A chain along the upper half; the lower end is pinned.
local function lay() h:drag{ { 0, -0.2, 0.5 }, { 0, 2.3, 0.5 } } end

test.before(function()
    h = hand.new("bones", { bar = bar() })
end)

test("a stroke along a bar lays a chain in its middle, and pins the body", function()
    local rest = h.scene:hash()
    lay()
    expect.equal(#chain(), 3)
    local joints = chain():joints()
    expect.near(joints[1], { 0, -0.2, 0 }, 0.02)
    expect.near(joints[4], { 0, 2.3, 0 }, 0.02)
    expect.near(joints[2], { 0, -0.2 + 2.5 / 3, 0 }, 0.05)
    local pinned = h.scene:get("bar"):region("pinned")
    expect.truthy(pinned:contains(h.scene:get("bar"):region("bottom"):vertices()[1]))
    expect.truthy(pinned:bounds().max[2] < -0.7)
    expect.equal(h:steps(), 1)
    expect.equal(h:there_and_back(), rest)
end)

test("the tip reaches for the cursor, and the body stays", function()
    lay()
    local joints = chain():joints()
    h:drag{ joints[4], { 1.2, 1.2, 0 } }
    expect.near(chain():joints()[4], { 1.2, 1.2, 0 }, 1e-6)
    expect.near(chain():joints()[1], joints[1], 1e-9)
    local mesh = h.scene:get("bar")
    expect.truthy(mesh:region("top"):center()[1] > 0.9)
    expect.near(mesh:region("bottom"):center(), { 0, -2.5, 0 }, 1e-9)
    expect.equal(h:steps(), 2)
    h:there_and_back()
end)

test("out of reach the chain is stretched, and says by how much", function()
    lay()
    h:drag{ chain():joints()[4], { 4, 1, 0 } }
    local joints = chain():joints()
    expect.truthy(joints[4][1] > 2)
    expect.truthy(h.host:draw().labels[1].text:find("from there", 1, true))
    h:press{ 4, -4, 0 }
    expect.equal(#h.host:draw().labels, 0)
end)

test("a bone turns with those behind it, about its joint and by the angle of the cursor", function()
    lay()
    local rest = chain():joints()
    local function turned(angle)
        local at, radius = rest[2], 0.4
        local a = math.rad(90 + angle)
        return { at[1] + radius * math.cos(a), at[2] + radius * math.sin(a), 0 }
    end
    h:drag{ turned(0), turned(30), turned(60) }
    local joints = chain():joints()
    expect.near(joints[2], rest[2], 1e-9)
    local length = rest[3][2] - rest[2][2]
    local a = math.rad(150)
    expect.near(joints[3], { rest[2][1] + length * math.cos(a), rest[2][2] + length * math.sin(a), 0 }, 0.05)
    -- A joint between two turns the bone that ends there.
    h:drag{ joints[3], { joints[2][1], joints[2][2] + 1, 0 } }
    expect.near(chain():joints()[3][1], rest[3][1], 0.05)
    h:there_and_back()
end)

test("limits are kept", function()
    h.host:set{ limit = 20 }
    lay()
    local rest = chain():joints()
    h:drag{ { rest[3][1], rest[3][2] + 0.4, 0 }, { rest[3][1] + 1, rest[3][2], 0 } }
    local joints = chain():joints()
    local angle = math.deg(math.atan(joints[4][1] - joints[3][1], joints[4][2] - joints[3][2]))
    expect.near(angle, 20, 0.5)
end)

test("the first joint moves the whole chain", function()
    lay()
    local rest = chain():joints()
    h:drag{ rest[1], { rest[1][1] + 0.5, rest[1][2] + 0.2, 0 } }
    for i, joint in ipairs(chain():joints()) do
        expect.near(joint, { rest[i][1] + 0.5, rest[i][2] + 0.2, rest[i][3] }, 1e-6)
    end
end)

test("joints are clicked one by one, and taken back", function()
    h:key("backspace")
    h:click{ 0, -0.2, 0.5 }
    h:click{ 0.3, 1, 0.5 }
    h:key("backspace")
    h:click{ 0, 1, 0.5 }
    h:click{ 0, 2.2, 0.5 }
    expect.equal(#h.host:draw().lines, 1)
    expect.equal(h:steps(), 0)
    h:key("enter")
    expect.equal(#chain(), 2)
    expect.near(chain():joints()[2], { 0, 1, 0 }, 0.02)
    expect.equal(h:steps(), 1)
    expect.error(function() h:key("enter") end, "click two joints")
end)

test("keys: to rest, away, finished; a second chain begins at the present shape", function()
    lay()
    h:drag{ chain():joints()[4], { 1.2, 1.2, 0 } }
    h:key("r")
    expect.near(chain():joints()[4][1], 0, 0.02)
    expect.near(h.scene:get("bar"):region("top"):center(), { 0, 2.5, 0 }, 1e-9)
    h:drag{ chain():joints()[4], { 0.8, 1.8, 0 } }
    h:key("delete")
    expect.falsy(pcall(deformer))
    local bent = h.scene:get("bar"):region("top"):center()
    expect.truthy(bent[1] > 0.5)
    lay()
    h:key("f")
    expect.falsy(pcall(deformer))
    expect.near(h.scene:get("bar"):region("top"):center(), bent, 1e-9)
    h:there_and_back()
end)

test("two chains of one body, and tab between them", function()
    local cross = lissom.shapes.bar{ across = 4, along = 40 }
    h = hand.new("bones", { bar = cross })
    h.host:set{ bones = 1, room = 0 }
    h:drag{ { 0, 0.5, 0.5 }, { 0, 2.2, 0.5 } }
    h:drag{ { 0, -0.5, 0.5 }, { 0, -2.2, 0.5 } }
    expect.equal(#deformer():bones(), 2)
    expect.equal(#h.host:draw().lines, 2)
    h:key("tab", "delete")
    expect.equal(#deformer():bones(), 1)
    expect.near(deformer():bones()[1]:joints()[1][2], -0.5, 0.02)
end)

test("Escape in the middle of a stroke and of a drag", function()
    local rest = h.scene:hash()
    h:press{ 0, -0.2, 0.5 }
    h:move{ 0, 1, 0.5 }
    expect.equal(#h.host:draw().lines, 1)
    h.host:cancel()
    expect.equal(h.scene:hash(), rest)
    lay()
    local laid = h.scene:hash()
    h:press(chain():joints()[4])
    h:move{ 1.2, 1.2, 0 }
    expect.truthy(h.scene:hash() ~= laid)
    h.host:cancel()
    expect.equal(h.scene:hash(), laid)
end)

test("a stroke beside the mesh does nothing, and one that leaves it ends there", function()
    local rest = h.scene:hash()
    h:drag{ { 2, -1, 0 }, { 2, 1, 0 } }
    expect.equal(h.scene:hash(), rest)
    expect.equal(h:steps(), 0)
    h:drag{ { 0, 0, 0.5 }, { 0, 2, 0.5 }, { 3, 2, 0.5 } }
    expect.equal(#chain(), 3)                                     -- it ends where the stroke left the body
    expect.truthy(chain():joints()[4][1] < 0.5)
end)

test("in a mirrored place bones follow the cursor too", function()
    local place = { { -1, 0, 0, 1 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } }
    h = hand.new("bones", { bar = bar() }, { places = { bar = place } })
    h:drag{ { 1, -0.2, 0.5 }, { 1, 2.3, 0.5 } }
    local rest = chain():joints()
    h:drag{ { 1, rest[3][2] + 0.4, 0 }, { 1.3, rest[3][2] + 0.3, 0 }, { 1.4, rest[3][2], 0 } }
    local joints = chain():joints()
    expect.near(joints[4][1], rest[3][1] - (rest[4][2] - rest[3][2]), 0.05)       -- to the right in the world
    h:drag{ { 1 - joints[4][1], joints[4][2], 0 }, { 2, 1.5, 0 } }
    expect.near(chain():joints()[4], { -1, 1.5, 0 }, 1e-6)
end)

test("chains are saved with the scene, and known to the tool again", function()
    h.host:set{ limit = 70 }
    lay()
    h:drag{ chain():joints()[4], { 1, 1.5, 0 } }
    local file = test.file("bones.lissom")
    h.scene:save(file)
    local scene = lissom.load_scene(file)
    expect.equal(scene:hash(), h.scene:hash())
    local joints = chain():joints()
    local loaded = scene:get("bar deformation"):bones()[1]
    for i, joint in ipairs(loaded:joints()) do expect.near(joint, joints[i], 1e-9) end
    loaded:turn(3, "z", 170)
    expect.truthy(loaded:joints()[4][1] < 2)
end)
