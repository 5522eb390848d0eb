-- What scripts of hairstyles share.
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
    "half_up", "high_ponytail", "locs", "long_straight", "messy", "mohawk", "pigtails", "pixie", "ponytail",
    "ringlets",
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

test("few strands of a preset are wider and many thinner, so that all cover as much", function()
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
    expect.near(width(2, 30000), 0.0002, 1e-6)
    expect.near(width(2, 60000), 0.0001, 1e-6)
    expect.near(width(2, 900000), 0.0002 / 3, 1e-6)
end)

-- The number of roots of hair in a band of elevations at the nape, and the mean distance from root to tip.
local function nape_band(hair, scalp, low, high)
    local styling = require "styling"
    local points, unit, first, count, sum = hair:points(), scalp:unit(), 1, 0, 0
    for _, size in ipairs(hair:point_counts()) do
        local root, tip = { points:get(first) }, { points:get(first + size - 1) }
        local azimuth, elevation = styling.angles(scalp:to_metres(root[1] / unit, root[2] / unit,
            root[3] / unit))
        if math.abs(azimuth) > 150 and elevation >= low and elevation < high then
            local square = 0
            for k = 1, 3 do square = square + (tip[k] - root[k]) ^ 2 end
            count, sum = count + 1, sum + math.sqrt(square)
        end
        first = first + size
    end
    return count, sum / math.max(count, 1)
end

test("hair of presets thins out, and is shorter, towards the hairline", function()
    local styling = require "styling"
    local head = lissom.shapes.head{ vertices = 12000 }
    local scalp = lissom.scalp(head, { softness = styling.softness })
    local preset = require "presets.buzz"
    local _, hair = preset.grow(head, { fade = 0 }, { count = 20000, resolution = 8000, scalp = scalp })
    -- The lowest band of four degrees with roots, and those above it.
    local counts, lengths = {}, {}
    for elevation = -60, 0, 4 do
        local count, length = nape_band(hair, scalp, elevation, elevation + 4)
        if count > 20 then counts[#counts + 1], lengths[#lengths + 1] = count, length end
    end
    expect.truthy(#counts > 6, "bands: " .. #counts)
    expect.truthy(counts[1] < 0.6 * counts[5], counts[1] .. " roots at the edge, inside " .. counts[5])
    expect.truthy(lengths[1] < 0.75 * lengths[5], lengths[1] .. " long at the edge, inside " .. lengths[5])
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

-- A style of its curves alone.
local function style_of(elevation)
    local style = lissom.hairstyle(head, { resolution = 5000, gravity = 0 })
    for _, azimuth in ipairs{ -90, 90, 180 } do
        style:add_stream{ points = { style:at{ azimuth = azimuth, elevation = 70, lift = 0.01 },
            style:at{ azimuth = azimuth, elevation = elevation, lift = 0.02 },
            style:at{ azimuth = azimuth, elevation = -30, lift = 0.02 } } }
    end
    return style
end

local function add_fringe(style)
    return style:add_stream{ points = { style:at{ azimuth = 0, elevation = 60, lift = 0.01 },
        style:at{ azimuth = 0, elevation = 40, lift = 0.02 } } }
end

local function two_layers(more)
    local layers = {
        { name = "lower", style = style_of(20), grow = { count = 100, length = 0.1 }, operators = {
            { "guides", count = 20 }, { "gather", spread = 0.001 }, { "push_out", clearance = 0.001 } } },
        { name = "upper", style = style_of(25), grow = { count = 50, length = 0.1, seed = 2 }, operators = {
            { "frizz", amplitude = 0.001 }, { "cut", hem = { { 0, -0.05 } } } } },
    }
    for key, value in pairs(more or {}) do layers[2][key] = value end
    return lissom.groom{ head = head, layers = layers }
end

local function refused(code, text, ...)
    local _, problem = lissom.try(...)
    expect.truthy(problem and problem.code == code, tostring(problem))
    expect.truthy(tostring(problem):find(text, 1, true), tostring(problem))
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
    expect.equal(g.evaluated, 8)
    expect.equal(g:hair():hash(), first)
    expect.equal(g.evaluated, 8)
    expect.truthy(g:set("lower", 2, { spread = 0.004 }):hair():hash() ~= first)
    expect.equal(g.evaluated, 11)
    expect.equal(g:set("lower", 2, { spread = 0.001 }):hair():hash(), first)
    expect.equal(g.evaluated, 14)
    expect.truthy(g:switch("upper", 2, false):hair():hash() ~= first)
    expect.equal(g.evaluated, 15)
    add_fringe(g:layer("upper").style)
    g:hair()
    expect.equal(g.evaluated, 18)
    g:grow("upper", { seed = 3 }):hair()
    expect.equal(g.evaluated, 21)
end)

local five_operators = "five operators on 20,000 strands are after an edit of a curve what a new groom "
    .. "gives, for one evaluation each"

test(five_operators, function()
    local style = style_of(20)
    local layers = { { style = style, grow = { count = 20000, length = 0.05 }, operators = {
        { "guides", count = 150 }, { "gather", factor = 0.5, ramp = 0.04 },
        { "frizz", amplitude = 0.001 }, { "noise", amplitude = 0.001 },
        { "push_out", clearance = 0.001 } } } }
    local g = lissom.groom{ head = head, layers = layers }
    g:hair()
    expect.equal(g.evaluated, 6)
    add_fringe(style)
    local edited = g:hair():hash()
    expect.equal(g.evaluated, 12)
    expect.equal(edited, lissom.groom{ head = head, layers = layers }:hair():hash())
end)

test("an upper layer lies over the lower one", function()
    -- Mean heights of the outer halves of both layers, above the middle of the head.
    local function heights(over)
        local style = style_of(20)
        local hair = lissom.groom{ head = head, layers = {
            { style = style, grow = { count = 1500, length = 0.12, clearance = 0.022, layer = 0 } },
            { style = style, over = over, grow = { count = 300, length = 0.12, clearance = 0.002, layer = 0,
                seed = 4 } } } }:hair()
        local scalp, unit = style:scalp(), style:scalp():unit()
        local sum, count = { 0, 0 }, { 0, 0 }
        for s = 1, #hair do
            local points, layer = hair:strand(s), s <= 1500 and 1 or 2
            for k = math.ceil(points:count() / 2), points:count(), 3 do
                local x, y, z = points:get(k)
                if scalp:to_metres(x / unit, y / unit, z / unit)[2] > 0 then
                    count[layer] = count[layer] + 1
                    sum[layer] = sum[layer] + head:nearest(x / unit, y / unit, z / unit).distance * unit
                end
            end
        end
        expect.truthy(count[1] > 300 and count[2] > 100)
        return sum[1] / count[1], sum[2] / count[2]
    end
    local lower, under = heights(false)
    expect.truthy(under < lower - 0.003, under .. " under " .. lower)
    local same, over = heights(true)
    expect.equal(same, lower)
    expect.truthy(over > lower, over .. " over " .. lower)
end)

test("a layer grows within its mask, given as numbers, a function or a region", function()
    local function share(mask)
        local hair = two_layers{ mask = mask, operators = {}, grow = { count = 60, length = 0.05 } }
            :switch("lower", nil, false):hair()
        local right = 0
        for s = 1, #hair do
            if hair:root(s).position[1] < 0 then right = right + 1 end
        end
        return right / #hair
    end
    local numbers = {}
    for v = 1, head:vertex_count() do numbers[v] = head:position(v) < 0 and 1 or 0 end
    expect.truthy(share(nil) < 0.8)
    expect.truthy(share(numbers) > 0.9)
    expect.truthy(share(function(_, x) return x < 0 end) > 0.9)
    expect.truthy(share(head:region{ where = function(_, x) return x < 0 end }) > 0.9)
    refused("invalid_argument", "has 3 numbers", two_layers, { mask = { 1, 1, 0 } })
    refused("invalid_argument", "no vertex", two_layers, { mask = function() return 0 end })
    refused("invalid_argument", "another mesh", two_layers,
        { mask = lissom.shapes.head{ vertices = 3000 }:region{ all = true } })
end)

test("operators are put in, taken out and named in errors", function()
    local g = two_layers()
    local first = g:hair():hash()
    g:insert("upper", { "noise", amplitude = 0.002 }, 1)
    expect.truthy(g:hair():hash() ~= first)
    expect.equal(g:remove("upper", 1):hair():hash(), first)
    refused("invalid_argument", "no operator 'comb_over'", g.insert, g, "upper", { "comb_over" })
    refused("out_of_range", "no layer 'middle'", g.layer, g, "middle")
    refused("out_of_range", "no operator 9", g.set, g, "upper", 9, {})
    refused("invalid_argument", "at least one layer", lissom.groom, { head = head, layers = {} })
    refused("invalid_argument", "needs a style", lissom.groom, { head = head, layers = { { name = "a" } } })
    refused("invalid_argument", "must be a lissom.Hairstyle, not a number", lissom.groom,
        { head = head, layers = { { style = 3 } } })
    refused("invalid_argument", "no option 'stile'", lissom.groom,
        { head = head, layers = { { stile = style_of(20) } } })
    refused("invalid_argument", "another head", lissom.groom,
        { head = lissom.shapes.head{ vertices = 3000 }, layers = { { style = style_of(20) } } })
    refused("invalid_argument", "two layers", lissom.groom,
        { head = head, layers = { { style = style_of(20), name = "a" },
            { style = style_of(20), name = "a" } } })
    refused("invalid_argument", "':'", g.hair)
    expect.equal(g:hair():hash(), first)
    g:set("upper", 1, { mask = function() return 1 end }):hair()
    refused("invalid_argument", "a groom cannot save", g.text, g)
end)

test("a groom that was saved and read makes the same hair", function()
    local g = two_layers{ mask = function(_, x) return x < 0 end }
    local path = test.file("groom.json")
    g:switch("upper", 1, false):save(path)
    local read = lissom.load_groom(path, head)
    expect.equal(read:hair():hash(), g:hair():hash())
    expect.equal(read:switch("upper", 1, true):hair():hash(), g:switch("upper", 1, true):hair():hash())
    expect.equal(read:text(), g:text())
    refused("invalid_argument", "has " .. head:vertex_count() .. " numbers", lissom.load_groom, path,
        lissom.shapes.head{ vertices = 3000 })
end)

test("damaged files of grooms are errors of their syntax", function()
    local g = two_layers()
    local path, text = test.file("groom.json"), g:text()
    local function read(bytes)
        local file = io.open(path, "wb")
        file:write(bytes)
        file:close()
        return select(2, lissom.try(lissom.load_groom, path, head))
    end
    expect.equal(read(text), nil)
    for size = 1, #text - 2, 97 do
        local problem = read(text:sub(1, size))
        expect.truthy(problem and problem.code == "file_syntax", size .. ": " .. tostring(problem))
    end
    for _, bytes in ipairs{ "[1, 2", '{"a": nul}', '"\\uZZ"', ("["):rep(5000), "{} {}",
        '{"format": "lissom groom"}' } do
        expect.equal(read(bytes).code, "file_syntax")
    end
    expect.equal(read((text:gsub('"version": 1', '"version": 7', 1))).code, "unsupported")
end)

test("a groom in a scene follows undo and redo, with its options and its curves", function()
    local g = two_layers()
    local scene = lissom.scene{}
    local style = g:layer("upper").style
    scene:add("head", head)
    scene:add("upper style", style)
    g:show(scene, "hair")
    local first, text = scene:get("hair"):hash(), g:text()
    g:set("lower", 2, { spread = 0.004 }):update("spread")
    local second = scene:get("hair"):hash()
    expect.truthy(second ~= first)
    scene:step("fringe", function()
        add_fringe(style)
        g:update()
    end)
    local third = scene:get("hair"):hash()
    expect.equal(scene:undo(), "fringe")
    expect.equal(scene:get("hair"):hash(), second)
    expect.equal(g:layer("upper").style, style)
    expect.equal(scene:undo(), "spread")
    expect.equal(scene:get("hair"):hash(), first)
    expect.equal(g:text(), text)
    expect.equal(g:layer("lower").operators[2].spread, 0.001)
    local before = g.evaluated
    g:update()
    expect.equal(scene:get("hair"):hash(), first)
    expect.truthy(g.evaluated <= before + 8)
    scene:redo()
    scene:redo()
    expect.equal(scene:get("hair"):hash(), third)
    local path = test.file("groom.lissom")
    scene:save(path)
    local opened = lissom.load_scene(path)
    local again = lissom.groom{ head = opened:get("head"), hair = opened:get("hair") }
    expect.equal(again:text(), g:text())
    refused("invalid_argument", "made by no groom", lissom.groom,
        { head = head, hair = style:grow{ count = 5, length = 0.05 } })
end)

test("an update that fails leaves the scene as it was", function()
    local g = two_layers()
    local scene = lissom.scene{}
    g:show(scene, "hair")
    local before = scene:hash()
    refused("out_of_range", "no group", g.update, g:set("lower", 2, { mask = "no such group" }))
    expect.equal(scene:hash(), before)
    g:set("lower", 2, { spread = 0.002, mask = { 1, 0 } })
    refused("invalid_argument", "mask", g.update, g)
    expect.equal(scene:hash(), before)
end)

-- ---- Operators

local vigorous = {
    gather = { guides = 40, spread = 0.004 }, twist = { guides = 300, wavelength = 0.03 },
    pinch = { guides = 40 }, curl = { guides = 40, radius = 0.02, ramp = 0.01 },
    wave = { guides = 40, radius = 0.02 }, frizz = { amplitude = 0.01 },
    clump = { clumps = 60, strength = 1 }, noise = { amplitude = 0.05 }, smooth = { iterations = 30 },
    straighten = {}, rotate = { axis = { 1, 0, 0 }, angle = 70 }, roll = { radius = 0.02 },
    puff = { amount = -0.02 }, displace = { offset = { 0.02, -0.01, -0.03 } }, set_length = { scale = 1.5 },
    blend = { guides = 20 }, duplicate = { copies = 2, radius = 0.01 }, resample = { count = 8 },
}

local names = {}
for name in pairs(vigorous) do names[#names + 1] = name end
table.sort(names)

for _, name in ipairs(names) do
    test("after " .. name .. " hardly any hair of a groom is deeper than a millimetre in the head", function()
        local style = style_of(20)
        local operator = { name }
        for key, value in pairs(vigorous[name]) do operator[key] = value end
        local layer = { style = style, grow = { count = 1500, length = 0.2 }, operators = { operator } }
        local hair = lissom.groom{ head = head, layers = { layer } }:hair()
        local stats = hair:stats{ style = style, depth = 0.001 }
        expect.truthy(stats.penetrating <= 0.001 * #hair, stats.penetrating .. " of " .. #hair)
        layer.collide = false
        local free = lissom.groom{ head = head, layers = { layer } }:hair()
        expect.truthy(free:hash() ~= style:grow{ count = 1500, length = 0.2 }:hash(), "it does nothing")
    end)
end

test("details of an example, or of a file with them, go onto other hair, and into a groom", function()
    local style = style_of(20)
    local function grow() return style:grow{ count = 60, length = 0.12, seed = 4 }:guides{ count = 6 } end
    local example = grow():curl{ radius = 0.004, wavelength = 0.02, ramp = 0.01, start = 0 }
    local hair = grow():detail{ from = example }
    expect.truthy(hair:stats().points > 2 * grow():stats().points)
    expect.near(hair:stats().mean_length, grow():stats().mean_length, 2e-4)
    local path = test.file("details.hair")
    example:details():save(path)
    local saved = grow():detail{ from = path }
    expect.truthy(saved:stats().points > 2 * grow():stats().points)
    local first = function(s) return s == 1 end
    local others = function(s) return s ~= 1 end
    local one = grow():detail{ from = example, mask = first }
    expect.equal(one:select{ where = others }:hash(), grow():select{ where = others }:hash())
    expect.truthy(one:select{ where = first }:hash() ~= grow():select{ where = first }:hash())
    local g = lissom.groom{ head = head, layers = { { style = style, grow = { count = 60, length = 0.12 },
        operators = { { "guides", count = 6 }, { "detail", from = path, scale = 0.8 } } } } }
    local text = g:text()
    local file = test.file("detailed.json")
    g:save(file)
    expect.equal(lissom.load_groom(file, head):hair():hash(), g:hair():hash())
    expect.truthy(text:find("details.hair", 1, true))
    refused("file_not_found", "nowhere.hair", hair.detail, hair, { from = "nowhere.hair" })
    refused("invalid_argument", "three points", hair.detail, hair,
        { from = lissom.strands{ points = { { 0, 0, 0 }, { 0, 1, 0 } }, counts = { 2 } } })
end)

test("options of operators have their ranges and values, for panels", function()
    local g = two_layers()
    local by_name = {}
    for _, one in ipairs(g:options("lower", 2)) do by_name[one.name] = one end
    expect.equal(by_name.spread.value, 0.001)
    expect.equal(by_name.spread.min, 0)
    expect.equal(by_name.factor.max, 1)
    expect.equal(by_name.keep_length.type, "boolean")
    by_name = {}
    for _, one in ipairs(g:options("lower")) do by_name[one.name] = one end
    expect.equal(by_name.count.value, 100)
    expect.equal(by_name.length.value, 0.1)
    local all = table.concat(g:operators(), " ")
    expect.truthy(all:find("attach blend braid", 1, true), all)
    for _, name in ipairs(g:operators()) do
        local list = g:insert("lower", { name }, 1):options("lower", 1)
        for _, one in ipairs(list) do expect.truthy(one.name and one.type and one.help, name) end
        if name == "gather" then expect.truthy(#list > 4) end
        g:remove("lower", 1)
    end
end)

test("a braid and a bun of a groom follow the ponytail of its style as it is drawn", function()
    local style = require("ponytails").style(head, {}, { resolution = 8000 })
    local function hair_of(operator)
        return lissom.groom{ head = head, layers = { { style = style, collide = false,
            grow = { count = 800, length = 0.3 }, operators = { operator } } } }:hair()
    end
    local plain = hair_of{ "smooth", iterations = 0 }
    local braid = hair_of{ "braid", length = 0.12, tuft = 0.02 }
    expect.truthy(braid:hash() ~= plain:hash())
    local name
    for _, curve in ipairs(style:curves()) do
        if curve:kind() == "ponytail" then name = curve:name() end
    end
    expect.equal(hair_of{ "braid", along = name, length = 0.12, tuft = 0.02 }:hash(), braid:hash())
    expect.truthy(hair_of{ "bun" }:hash() ~= plain:hash())
    refused("out_of_range", "no curve 'nothing'", hair_of, { "braid", along = "nothing" })
end)

test("places and layers that are none are refused, and strands stay as they are", function()
    local style, other = style_of(20), lissom.shapes.head{ vertices = 5000 }
    local hair, scalp = style:grow{ count = 300, length = 0.12 }, style:scalp()
    local before = hair:hash()
    local top = { plane = { point = { 0, 0, 0 }, normal = { 0, 1, 0 } } }
    refused("invalid_argument", "did not grow on", hair.frizz, hair, { mask = other:region(top) })
    refused("invalid_argument", "did not grow on", hair.select, hair, { region = other:region(top) })
    expect.truthy(lissom.try(hair.select, hair, { region = head:region(top) }))
    local c = scalp:center()
    local inside = { { c[1], c[2], c[3] }, { c[1], c[2] - 0.01 / scalp:unit(), c[3] } }
    for _, name in ipairs{ "braid", "feed_braid" } do
        refused("invalid_argument", "inside the head", hair[name], hair,
            { spine = inside, scalp = scalp, across = scalp:left() })
    end
    refused("invalid_argument", "over itself", hair.push_out, hair, { head = style, layer = hair })
    refused("invalid_argument", "only", hair.braid, hair:copy():select{ first = 2 }, { scalp = scalp,
        across = scalp:left(), spine = { scalp:at{ azimuth = 180, elevation = 0, lift = 0.02 },
            scalp:at{ azimuth = 180, elevation = -20, lift = 0.03 } } })
    expect.equal(hair:hash(), before)
end)

test("every operator has its swatch in the picture of the guide", function()
    local file = assert(io.open(package.searchpath("swatches", package.path)))
    local text = file:read("*a")
    file:close()
    -- They assign, or need a head.
    local unseen = { guides = true, attach = true, push_out = true, shrinkwrap = true }
    for _, name in ipairs(two_layers():operators()) do
        expect.truthy(unseen[name] or text:find('{ "' .. name .. '", function', 1, true), name)
    end
end)

-- ---- Styles that are no presets

local examples = package.searchpath("styling", package.path):gsub("scripts/styling%.lua$", "examples/hair/")

local function example_style(name)
    local preset = assert(loadfile(examples .. name .. ".lua"))("presets." .. name)
    return preset.grow(lissom.shapes.head{ vertices = 6000 }, {}, { count = 1500, resolution = 8000 })
end

for _, name in ipairs{ "french_braid", "faux_hawk", "finger_waves" } do
    test("the " .. name:gsub("_", " ") .. " of the examples grows, and lies outside of the head", function()
        local style, hair = example_style(name)
        expect.truthy(#hair > 700, #hair)
        local stats = hair:stats{ style = style, depth = 0.001 }
        expect.truthy(stats.penetrating <= 0.002 * #hair, stats.penetrating)
        local lines = 0
        for _ in io.lines(examples .. name .. ".lua") do lines = lines + 1 end
        expect.truthy(lines <= 60, lines)
    end)
end

test("interpolated hair fills the scalp between its guides, on its side of a parting", function()
    local style = lissom.hairstyle(head, { resolution = 8000 })
    for _, side in ipairs{ -1, 1 } do
        style:add_stream{ points = { style:at{ azimuth = 20 * side, elevation = 70, lift = 0.01 },
            style:at{ azimuth = 80 * side, elevation = 40, lift = 0.01 },
            style:at{ azimuth = 90 * side, elevation = -10, lift = 0.02 } } }
    end
    local guides = style:grow{ count = 300, length = 0.12 }
    local hair = guides:interpolate{ style = style, count = 4000 }
    expect.equal(#hair, 4000)
    local few, many = guides:stats(), hair:stats{ style = style, depth = 0.003 }
    expect.near(many.mean_length, few.mean_length, 0.02)
    expect.truthy(many.penetrating < 0.02 * #hair, many.penetrating)
    local scalp, crossing = style:scalp(), 0
    for s = 1, #hair do
        local points = hair:strand(s)
        local function across(k)
            local x, y, z = points:get(k)
            return scalp:to_metres(x / scalp:unit(), y / scalp:unit(), z / scalp:unit())[1]
        end
        local root, tip = across(1), across(points:count())
        if math.abs(root) > 0.01 and root * tip < 0 then crossing = crossing + 1 end
    end
    expect.truthy(crossing < 0.01 * #hair, crossing)
    expect.error(function()
        guides:select{ strands = {} }:interpolate{ style = style, count = 10 }
    end, "there are no guides")
end)

test("duplicates lie beside their strand, with ids and guides of their own", function()
    local hair = style_of(20):grow{ count = 50, length = 0.1 }
    local before = hair:select{ first = 50 }:hash()
    hair:duplicate{ copies = 3, radius = 0.002, tip = 0 }
    expect.equal(#hair, 200)
    expect.equal(hair:select{ first = 50 }:guides{ count = 5 }:hash() ~= before, true)
    local seen = {}
    for s = 1, 200 do
        local root = hair:root(s)
        expect.equal(seen[root.id], nil)
        seen[root.id] = true
        if s > 50 then
            local original = hair:root((s - 51) % 50 + 1)
            expect.equal(root.guide, original.id)
            local away = 0
            for i = 1, 3 do away = away + (root.position[i] - original.position[i]) ^ 2 end
            expect.truthy(math.sqrt(away) <= 0.00201)
            local a, b = hair:strand(s), hair:strand((s - 51) % 50 + 1)
            local x, y, z = a:get(a:count())
            local u, v, w = b:get(b:count())
            expect.near(x - u, 0, 1e-6)
            expect.near(y - v, 0, 1e-6)
            expect.near(z - w, 0, 1e-6)
        end
    end
end)

test("attached hair is rooted on the head", function()
    local style = style_of(20)
    local hair = style:grow{ count = 40, length = 0.1 }
    local points, counts = {}, hair:point_counts()
    local all = hair:points()
    for i = 1, all:count() do
        local x, y, z = all:get(i)
        points[i] = { x + 0.003, y + 0.004, z }
    end
    local bare = lissom.strands{ points = points, counts = counts }
    expect.equal(bare:root(1).face, nil)
    bare:attach{ head = style }
    for s = 1, 40 do
        local root = bare:root(s)
        expect.truthy(root.face)
        local p, unit = root.position, style:scalp():unit()
        expect.near(head:nearest(p[1] / unit, p[2] / unit, p[3] / unit).distance * unit, 0, 1e-6)
    end
end)

test("colours go from the root to the tip", function()
    local hair = style_of(20):grow{ count = 5, length = 0.1 }
    hair:set_colors{ profile = { { 0.1, 0, 0 }, { 0.5, 0, 0 } } }
    local path = test.file("hair.usda")
    hair:save(path)
    local file = io.open(path, "rb")
    local text = file:read("*a")
    file:close()
    local first, second = text:match("displayColor = %[%(([%d%.e%-]+).-%), %(([%d%.e%-]+)")
    expect.near(tonumber(first), 0.1, 1e-6)
    expect.truthy(tonumber(second) > 0.1 and tonumber(second) < 0.5)
    expect.error(function() hair:set_colors{ profile = { { 1, 0, 0 } } } end, "two or more")
end)

test("every counterpart of Blender's nodes that the guide names exists", function()
    local script = package.searchpath("hairdo", package.path)
    local file = assert(io.open((script:gsub("scripts/hairdo.lua$", "docs/guide/hair.md")), "rb"))
    local text = file:read("*a")
    file:close()
    local hair = lissom.strands{ points = { { 0, 0, 0 }, { 0, 1, 0 } }, counts = { 2 } }
    local rows = 0
    for row in text:match("| Blender |.-\n\n"):gmatch("\n| ([^|]+ |[^\n]+)") do
        if not row:match("^%-") then
            rows = rows + 1
            local named = 0
            for name in row:gmatch("`hair:([%w_]+)") do
                named = named + 1
                expect.truthy(hair[name], name)
            end
            for name in row:gmatch("`style:([%w_]+)") do
                named = named + 1
                expect.truthy(style_of(20)[name], name)
            end
            expect.truthy(named > 0, row)
        end
    end
    expect.equal(rows, 26)
end)

test("hair is darker the more melanin it has, redder for its red part, and greyer for grey", function()
    local styling = require "styling"
    local function parts(...) return styling.linear(styling.color(...)) end
    local light = 1
    for melanin = 0.05, 0.95, 0.1 do
        local c = parts(melanin, 0.1)
        expect.truthy(c[1] < light and c[1] >= c[2] and c[2] >= c[3])
        light = c[1]
    end
    local brown, red, grey = parts(0.5, 0), parts(0.5, 1), parts(0.5, 0, 0.9)
    expect.truthy(red[1] / red[3] > brown[1] / brown[3])
    expect.truthy(grey[1] - grey[3] < brown[1] - brown[3] and grey[1] > brown[1])
end)

test("highlights colour whole locks, about as many as asked", function()
    local styling = require "styling"
    local hair = style_of(20):grow{ count = 1000, length = 0.1 }:guides{ count = 100 }
    styling.highlights(hair, "brown", "blond", 0.3)
    local path = test.file("hair.usda")
    hair:save(path)
    local file = io.open(path, "rb")
    local text = file:read("*a")
    file:close()
    local first = styling.linear(styling.colors.blond)[1]
    local count, all = 0, 0
    for value in text:match("displayColor = %[(.-)%]"):gmatch("%(([%d%.e%-]+),") do
        all = all + 1
        if math.abs(tonumber(value) - first) < 1e-4 then count = count + 1 end
    end
    expect.equal(all, 1000)
    expect.truthy(count > 150 and count < 450, count)
end)

-- Hair of others that becomes a style.
local refit = require "refit"
local bald = lissom.shapes.head{ vertices = 4000 }
local bald_scalp = lissom.scalp(bald)

-- Hair that falls to all sides, longer behind.
local function given()
    local style = lissom.hairstyle(bald, { scalp = bald_scalp, gravity = 0, resolution = 8000 })
    for azimuth = 0, 315, 45 do
        local points = {}
        for i, place in ipairs{ { 62, 0.008 }, { 35, 0.018 }, { 5, 0.02 }, { -25, 0.022 } } do
            points[i] = bald_scalp:at{ azimuth = azimuth, elevation = place[1], lift = place[2] }
        end
        style:add_stream{ points = points }
    end
    return style:grow{ count = 1200, length = function(_, _, _, z) return z < 0 and 0.16 or 0.1 end }
end

-- The root mean square of distances between the points of two sets.
local function apart(a, b)
    local p, q, sum = a:points(), b:points(), 0
    for i = 1, #p do sum = sum + (p[i] - q[i]) ^ 2 / #p end
    return math.sqrt(3 * sum)
end

test("hair that lies on its head stays where it lies", function()
    local hair = given()
    local motion, height = refit.place(hair, bald_scalp)
    expect.equal(motion.scale, 1)
    expect.truthy(height < 1e-4)
    expect.near(apart(refit.move(hair:copy(), motion), hair), 0, 1e-7)
end)

test("hair in another unit, with another axis up, turned and beside the head, is brought onto it", function()
    local hair = given()
    for _, case in ipairs{ { up = "y", turn = 0, scale = 100 }, { up = "z", turn = 90, scale = 39.37 },
        { up = "y", turn = 180, scale = 1000 } } do
        local moved = hair:copy()
        moved:transform{ rotate = { axis = "y", angle = -case.turn }, scale = case.scale }
        if case.up == "z" then moved:transform{ rotate = { axis = "x", angle = 90 } } end
        moved:transform{ translate = { 3 * case.scale, -case.scale, 2 * case.scale } }
        local motion, height = refit.place(moved, bald_scalp)
        expect.equal(motion.up, case.up)
        expect.equal(motion.turn, case.turn)
        expect.near(motion.scale * case.scale, 1, 0.06)
        expect.truthy(height < 0.003)
        local off = apart(refit.move(moved, motion), hair)
        expect.truthy(off < 0.02, "off by " .. off)
    end
end)

test("millimetres on a head in metres are only a unit", function()
    local hair = given()
    local motion = refit.place(hair:copy():transform{ scale = 1000 }, bald_scalp)
    expect.near(motion.scale, 0.001, 1e-12)
    expect.equal(motion.move[1], 0)
end)

test("a style of given hair flows as that does, as long, and is edited like one's own", function()
    local hair = given()
    local made = refit.style(hair, bald, { guides = 60, resolution = 12000 })
    expect.truthy(made.angle < 8, "directions are off by " .. made.angle)
    expect.truthy(made.length < 0.12, "lengths are off by " .. made.length)
    expect.equal(#made.guides:guides(), 60)
    expect.equal(#made.style:curves(), 60)
    expect.truthy(#made.hair > 0.9 * #hair)
    -- Its text makes the same hair, and a curve that is switched off other hair.
    local again = lissom.read_style(made.style:text(), bald, { scalp = made.style:scalp() })
    expect.equal(again:grow(made.grow):hash(), made.style:grow(made.grow):hash())
    made.style:curves()[1]:remove()
    expect.truthy(again:grow(made.grow):hash() ~= made.style:grow(made.grow):hash())
end)

test("strands that mostly run apart from all others are strays, and no others", function()
    local hair = given()
    local all = hair:copy()
    expect.equal(refit.remove_strays(all, hair, 0.01), 0)
    all:append(hair:select{ first = 5 }:transform{ translate = { 0, 0.3, 0 } })
    expect.equal(refit.remove_strays(all, hair, 0.01), 5)
    expect.equal(#all, #hair)
end)

test("hair grows where there was hair, and nowhere else", function()
    local hair = given()
    local left = hair:select{ where = function(_, x) return x > 0 end }
    local made = refit.style(left, bald, { guides = 20, resolution = 8000 })
    local _, wrong = nil, 0
    for s = 1, #made.hair do
        if made.hair:root(s).position[1] < -0.012 then wrong = wrong + 1 end
    end
    expect.equal(wrong, 0)
end)

test("two strands and strands without length make no style", function()
    expect.error(function() refit.style(given():select{ first = 2 }, bald) end, "at least three strands")
    local dots = lissom.strands{ points = { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0.1, 0 }, { 0, 0.1, 0 } },
        counts = { 2, 2 } }
    expect.error(function() refit.style(dots, bald, { place = false }) end, "at least three strands")
end)

local curls = require "curls"

test("curls of strands are measured: their radius, their length and their sense", function()
    expect.equal(curls.measure(given()), nil)
    for _, hand in ipairs{ "left", "right" } do
        local hair = given():curl{ radius = 0.006, wavelength = 0.025, hand = hand, start = 0.01, ramp = 0.02,
            hang = 0, variation = 0.1, keep_length = false }
        local found = curls.measure(hair)
        expect.near(found.radius, 0.006, 0.0009)
        expect.near(found.wavelength, 0.025, 0.004)
        expect.equal(found.hand, hand)
        expect.truthy(found.share > 0.8 and found.depth == 1)
    end
end)

test("a style of curled hair flows as its courses do, with its curls as an operator on top", function()
    local hair = given():curl{ radius = 0.005, wavelength = 0.025, hand = "left", start = 0.01, ramp = 0.02,
        hang = 0, keep_length = false }
    local made = refit.style(hair, bald, { guides = 60, resolution = 12000 })
    expect.truthy(made.angle < 15, "directions are off by " .. made.angle)
    expect.truthy(made.length < 0.2, "lengths are off by " .. made.length)
    local again = curls.measure(made.hair)
    expect.near(again.radius, 0.005, 0.001)
    expect.equal(again.hand, "left")
    expect.equal(refit.style(hair, bald, { guides = 60, resolution = 8000, curls = false }).curl, nil)
end)

test("the ring at the end of a braid lies on its spine, as far on as the braid is long", function()
    local tails = require "tails"
    for _, unit in ipairs{ 1, 0.01 } do
        local large = lissom.shapes.head{ vertices = 3000 }:transform{ scale = 1 / unit }
        local scalp = lissom.scalp(large, { unit = unit })
        local spine = {}
        for i, down in ipairs{ 0, 0.05, 0.17, 0.4 } do spine[i] = { 0.3 / unit, -down / unit, 0 } end
        local box = tails.end_ring(scalp, spine, 0.21, 0.006):bounds()
        expect.near(0.5 * (box.min[2] + box.max[2]) * unit, -0.21, 1e-4)
        expect.near(0.5 * (box.min[1] + box.max[1]) * unit, 0.3, 1e-4)
        expect.near(0.5 * (box.max[1] - box.min[1]) * unit, 0.0086, 2e-4)
    end
end)

test("hair that missed its tie and hangs free is taken away, that on the head stays", function()
    local scalp = lissom.scalp(lissom.shapes.head{ vertices = 3000 })
    local points, counts, unit = {}, {}, scalp:unit()
    for i, lift in ipairs{ 0.01, 0.02, 0.08 } do
        for _, place in ipairs{ { azimuth = 170, elevation = 10 * i },
            { azimuth = 170, elevation = 10 * i, lift = lift } } do
            local p = scalp:at(place)
            points[#points + 1] = { p[1] * unit, p[2] * unit, p[3] * unit }
        end
        counts[i] = 2
    end
    expect.equal(#hairdo.cull_missed(lissom.strands{ points = points, counts = counts }, scalp), 2)
end)
