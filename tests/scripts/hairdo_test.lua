-- What scripts of hairstyles share.
local groom = require "groom"
local hairdo = require "hairdo"
local lissom = require "lissom"

test("a head whose unit nobody can guess gets it from the parameters, and nothing warns", function()
    local head = lissom.shapes.head{ vertices = 3000 }:transform{ scale = 3 }
    local told = {}
    lissom.listen{ log = function(level, message) told[#told + 1] = level .. ": " .. message end }
    expect.near(hairdo.scalp(head, { unit = 1 / 3 }):unit(), 1 / 3)
    local style = hairdo.style(head, { unit = 1 / 3, resolution = 6000 })
    local spine = {}
    for i, place in ipairs{ { 30, 0.02 }, { 20, 0.1 }, { 0, 0.15 } } do
        spine[i] = style:at{ azimuth = 180, elevation = place[1], lift = place[2] }
    end
    style:add_ponytail{ spine = spine, name = "tail" }
    local params = { out = test.folder(), name = "hair", format = "usda", detail = true }
    hairdo.finish(style, style:grow{ count = 500, length = 0.2 }, params)
    expect.equal(table.concat(told, "\n"), "")
    lissom.listen{}
    expect.truthy(#assert(lissom.load_strands(test.file("hair.usda"))) > 100)
end)

local presets = { "afro", "bob", "braid", "bun", "buzz", "centre_part", "cornrows", "crop", "crown_braid",
    "half_up", "high_ponytail", "locs", "long_straight", "messy", "mohawk", "pigtails", "pixie", "ringlets",
    "side_part", "slick_back", "spiky", "topknot", "two_braids", "undercut", "waves" }

for _, name in ipairs(presets) do
    test(name .. " makes hair on a head that stays out of it, by parameters that it names", function()
        local preset = require("presets." .. name)
        local head = lissom.shapes.head{ vertices = 4000 }
        local style, hair, look = preset.grow(head, {}, { count = 400, resolution = 8000 })
        local stats = hair:stats{ style = style, depth = 0.001 }
        expect.truthy(#hair > 200, name)
        expect.equal(stats.not_finite, 0, name)
        expect.truthy(stats.penetrating <= 0.01 * #hair, name .. ": " .. stats.penetrating .. " inside")
        expect.truthy(look.unit > 0, name)
        expect.error(function() preset.grow(head, { bounce = 1 }) end, "no parameter 'bounce'")
    end)
end

test("few strands of a preset are wider, so that they cover as much as many", function()
    local styling = require "styling"
    local function width(count, all)
        local counts, points = {}, {}
        for i = 1, count do
            counts[i], points[2 * i - 1], points[2 * i] = 2, { i, 0, 0 }, { i, 1, 0 }
        end
        local hair = styling.set_width(lissom.strands{ points = points, counts = counts }, 0.0002, all)
        local path = test.file("hair.usda")
        hair:select{ first = 1 }:save(path)
        local file = io.open(path, "rb")
        local text = file:read("*a")
        file:close()
        return tonumber(text:match("widths = %[([%d%.e%-]+)"))
    end
    expect.near(width(2), 0.0006, 1e-6)
    expect.near(width(2, 10000), 0.0004, 1e-6)
    expect.near(width(2, 20000), 0.0002, 1e-6)
    expect.near(width(2, 90000), 0.0002, 1e-6)
end)

test("another seed gives another head of hair, the same seed the same", function()
    local head = lissom.shapes.head{ vertices = 6000 }
    local preset = require "presets.spiky"
    local function hash(seed)
        local _, hair = preset.grow(head, { seed = seed }, { count = 200, resolution = 6000 })
        return hair:hash()
    end
    expect.equal(hash(2), hash(2))
    expect.truthy(hash(2) ~= hash(3))
end)

-- ---- Grooms

local head = lissom.shapes.head{ vertices = 4000 }

local function style_of(elevation)
    local style = lissom.hairstyle(head, { resolution = 5000 })
    for _, azimuth in ipairs{ -90, 90, 180 } do
        style:add_stream{ points = { style:at{ azimuth = azimuth, elevation = 70, lift = 0.01 },
            style:at{ azimuth = azimuth, elevation = elevation, lift = 0.02 },
            style:at{ azimuth = azimuth, elevation = -30, lift = 0.02 } } }
    end
    return style
end

local function two_layers()
    return groom.new{ head = head, layers = {
        { name = "lower", style = style_of(20), grow = { count = 100, length = 0.1 }, operators = {
            { "guides", count = 20 }, { "gather", spread = 0.001 }, { "push_out", clearance = 0.001 } } },
        { name = "upper", style = style_of(25), grow = { count = 50, length = 0.1, seed = 2 }, operators = {
            { "frizz", amplitude = 0.001 }, { "cut", hem = { { 0, -0.05 } } } } },
    } }
end

test("a groom is the hair of its layers after their operators", function()
    local g = two_layers()
    local by_hand = style_of(20):grow{ count = 100, length = 0.1 }
    by_hand:guides{ count = 20 }:gather{ spread = 0.001 }:push_out{ head = style_of(20), clearance = 0.001 }
    expect.equal(g:switch("upper", nil, false):hair():hash(), by_hand:hash())
    expect.equal(#g:switch("upper", nil, true):hair(), 150)
end)

test("a groom evaluates again only what follows a change", function()
    local g = two_layers()
    local first = g:hair():hash()
    expect.equal(g.evaluated, 7)
    expect.equal(g:hair():hash(), first)
    expect.equal(g.evaluated, 7)
    expect.truthy(g:set("lower", 2, { spread = 0.004 }):hair():hash() ~= first)
    expect.equal(g.evaluated, 9)
    expect.equal(g:set("lower", 2, { spread = 0.001 }):hair():hash(), first)
    expect.truthy(g:switch("upper", 2, false):hair():hash() ~= first)
    expect.equal(g.evaluated, 11)
    local style = g:layer("upper").style
    style:add_stream{ points = { style:at{ azimuth = 0, elevation = 60, lift = 0.01 },
        style:at{ azimuth = 0, elevation = 40, lift = 0.02 } } }
    g:hair()
    expect.equal(g.evaluated, 13)
end)

test("operators are put in, taken out and named in errors", function()
    local g = two_layers()
    local first = g:hair():hash()
    g:insert("upper", { "noise", amplitude = 0.002 }, 1)
    expect.truthy(g:hair():hash() ~= first)
    expect.equal(g:remove("upper", 1):hair():hash(), first)
    expect.error(function() g:insert("upper", { "comb_over" }):hair() end, "no method 'comb_over'")
    expect.equal(g:remove("upper", 3):hair():hash(), first)
    expect.error(function() g:layer("middle") end, "no layer 'middle'")
    expect.error(function() g:set("upper", 9, {}) end, "no operator 9")
    expect.error(function() groom.new{ head = head, layers = {} } end, "at least one layer")
    expect.error(function() groom.new{ head = head, layers = { { name = "a" } } } end, "needs a style")
    expect.error(function()
        g:set("upper", 1, { mask = function() return 1 end }):hair()
    end, "a groom cannot save")
end)

test("a groom that was saved and read makes the same hair", function()
    local g = two_layers()
    local path = test.file("groom.json")
    g:switch("upper", 1, false):save(path)
    local read = groom.load(path, head)
    expect.equal(read:hair():hash(), g:hair():hash())
    expect.equal(read:switch("upper", 1, true):hair():hash(), g:switch("upper", 1, true):hair():hash())
    local file = io.open(path, "wb")
    file:write('{"layers": [')
    file:close()
    expect.error(function() groom.load(path, head) end, "no JSON at byte")
end)
