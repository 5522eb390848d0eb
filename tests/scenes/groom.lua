-- Layers of a groom, switched and changed in the panel.
local hand = require "hand"
local lissom = require "lissom"

local head = lissom.shapes.head{ vertices = 3000 }
local h, groom

local function style_of(elevation)
    local style = lissom.hairstyle(head, { resolution = 4000 })
    for _, azimuth in ipairs{ -90, 90, 180 } do
        style:add_stream{ points = { style:at{ azimuth = azimuth, elevation = 70, lift = 0.01 },
            style:at{ azimuth = azimuth, elevation = elevation, lift = 0.02 } } }
    end
    return style
end

test.before(function()
    groom = lissom.groom{ head = head, layers = {
        { name = "sides", style = style_of(10), grow = { count = 60, length = 0.08 }, operators = {
            { "guides", count = 10 }, { "gather", spread = 0.001 } } },
        { name = "top", style = style_of(30), grow = { count = 30, length = 0.05, seed = 2 },
            operators = { { "frizz", amplitude = 0.001 } } },
    } }
    h = hand.new("navigate", { head = head })
    groom:show(h.scene, "hair")
    h.scene:clear_history()
    h:use("groom")
end)

local function hair_hash() return h.scene:get("hair"):hash() end

local function schema()
    local by_name, names = {}, {}
    for i, one in ipairs(h.tool.params:schema()) do by_name[one.name], names[i] = one, one.name end
    return by_name, table.concat(names, " ")
end

test("the panel lists layers and operators with switches, and the options of the chosen one", function()
    local rows, names = schema()
    expect.truthy(names:find("l1_01_guides l1_02_gather l1_on l2_01_frizz l2_on", 1, true), names)
    expect.equal(rows.l1_on.group, "1 sides")
    expect.equal(rows.l2_01_frizz.value, true)
    expect.equal(rows.chosen.value, "1 sides: growth")
    expect.near(rows.set_length.value, 0.08, 1e-12)
    expect.equal(rows.set_count.value, 60)
    h.host:set{ chosen = "1 sides: 2 gather" }
    rows = schema()
    expect.near(rows.set_spread.value, 0.001, 1e-12)
    expect.equal(rows.set_spread.unit, "metres")
    expect.equal(rows.set_factor.max, 1)
    expect.equal(rows.set_count, nil)
    expect.equal(h:steps(), 0)
end)

test("a slider changes an option in one step, which undo takes back in the panel too", function()
    local before = hair_hash()
    h.host:set{ chosen = "1 sides: 2 gather" }
    h.host:set{ set_spread = 0.004 }
    expect.equal(h:steps(), 1)
    expect.truthy(hair_hash() ~= before)
    expect.near(schema().set_spread.value, 0.004, 1e-12)
    expect.equal(h.scene:get("hair"):comment():find('"spread": 0.004', 1, true) ~= nil, true)
    h.host:undo()
    expect.equal(hair_hash(), before)
    h.host:draw()
    expect.near(schema().set_spread.value, 0.001, 1e-12)
    h.host:redo()
    h.host:draw()
    expect.near(schema().set_spread.value, 0.004, 1e-12)
end)

test("switches take operators and layers out and back", function()
    local before = hair_hash()
    h.host:set{ l1_02_gather = false }
    expect.truthy(hair_hash() ~= before)
    h.host:set{ l2_on = false }
    expect.equal(#h.scene:get("hair"), 60)
    expect.equal(schema().l2_on.value, false)
    h.host:set{ l2_on = true }
    h.host:set{ l1_02_gather = true }
    expect.equal(hair_hash(), before)
    expect.equal(h:steps(), 4)
    h:there_and_back()
end)

test("operators are added behind the chosen one, moved and removed", function()
    h.host:set{ chosen = "1 sides: 1 guides" }
    h.host:set{ add = "curl" }
    local rows, names = schema()
    expect.truthy(names:find("l1_01_guides l1_02_curl l1_03_gather", 1, true), names)
    expect.equal(rows.chosen.value, "1 sides: 2 curl")
    expect.near(rows.set_radius.value, 0.0095, 1e-12)
    h.host:set{ set_radius = 0.004 }
    h:key("+")
    names = select(2, schema())
    expect.truthy(names:find("l1_01_guides l1_02_gather l1_03_curl", 1, true), names)
    expect.near(schema().set_radius.value, 0.004, 1e-12)
    h:key("delete")
    expect.equal(select(2, schema()):find("curl", 1, true), nil)
    expect.equal(h:steps(), 4)
    h:there_and_back()
end)

test("growth of a layer has sliders too", function()
    h.host:set{ chosen = "2 top: growth" }
    h.host:set{ set_count = 45 }
    expect.equal(#h.scene:get("hair"), 105)
end)

test("a change that an operator refuses leaves the hair and the panel as they were", function()
    local before = hair_hash()
    h.host:set{ chosen = "1 sides: 1 guides" }
    local problem = select(2, lissom.try(h.host.set, h.host, { add = "cut" }))
    expect.truthy(problem, "a cut without a shape")
    expect.equal(hair_hash(), before)
    expect.equal(h:steps(), 0)
    expect.equal(select(2, schema()):find("cut", 1, true), nil)
    h.host:set{ l2_on = false }
    expect.equal(#h.scene:get("hair"), 60)
end)

test("a scene without a groom says what to do", function()
    h = hand.new("groom", { head = head })
    expect.equal(#h.tool.params:schema(), 0)
    local problem = select(2, lissom.try(h.host.key, h.host, { key = "delete" }))
    expect.truthy(tostring(problem):find("show one", 1, true), tostring(problem))
end)

test("a saved scene opens with its groom in the panel", function()
    local path = test.file("groom.lissom")
    h.scene:save(path)
    local opened = lissom.load_scene(path)
    local host = lissom.tool_host{ scene = opened, camera = h.camera, tool = lissom.load_tool("groom") }
    expect.equal(host.tool.params.l1_on, true)
    host:set{ l1_on = false }
    expect.equal(#opened:get("hair"), 30)
end)
