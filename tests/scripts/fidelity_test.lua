-- Hairstyles to the letter of the thesis, as scripts make them.
local lissom = require "lissom"

local head = lissom.shapes.head{ vertices = 3000 }

local function style_of(options)
    options.resolution = options.resolution or 12000
    return assert(lissom.hairstyle(head, options))
end

-- A stream at a side, a parting, and a tail that falls behind.
local function with_curves(style, tail)
    style:add_stream{ points = { style:at{ azimuth = 20, elevation = 50, lift = 0.01 },
        style:at{ azimuth = 70, elevation = 10, lift = 0.02 } } }
    style:add_dividing{ tilt = { 10, 30 }, points = { style:at{ azimuth = 0, elevation = 45 },
        style:at{ azimuth = 0, elevation = 80 } } }
    local behind = { azimuth = 180, elevation = 25, lift = 0.02 }
    local tie, out = style:at(behind), style:normal_at(behind)
    local spine = { tie }
    for i = 1, 3 do spine[i + 1] = { tie[1], tie[2] - 0.01 * i * i, tie[3] + 0.03 * i * out[3] } end
    tail = tail or {}
    tail.spine, tail.name = spine, "tail"
    style:add_ponytail(tail)
    return style, tie
end

local function norm(a) return math.sqrt(a[1] ^ 2 + a[2] ^ 2 + a[3] ^ 2) end

-- Counts of kinds, and the constraints of one kind.
local function kinds_of(style)
    local counts, lists = {}, {}
    for _, one in ipairs(style:constraints()) do
        counts[one.kind] = (counts[one.kind] or 0) + 1
        lists[one.kind] = lists[one.kind] or {}
        table.insert(lists[one.kind], one)
    end
    return counts, lists
end

test("the ring has 1.3 to 1.9 radii, all weights are 100 and all lengths those of section 4.5", function()
    local style, tie = with_curves(style_of{ fidelity = "thesis", resolution = 50000 }, { radius = 0.02 })
    expect.equal(style:stats().fidelity, "thesis")
    local step = style:stats().step
    local counts, lists = kinds_of(style)
    local lengths = { stream = 1, parting = 1, separation = 0.3, section = 1, spine = 1, gather = 0.6 }
    for kind, length in pairs(lengths) do
        expect.truthy(counts[kind] > 3, kind)
        for _, one in ipairs(lists[kind]) do
            expect.near(norm(one.vector), length, 1e-6)
            expect.equal(one.weight, 100)
        end
    end
    for _, one in ipairs(lists.gather) do
        local from = { one.point[1] - tie[1], one.point[2] - tie[2], one.point[3] - tie[3] }
        local unit = style:scalp():scale()
        expect.truthy(norm(from) > 1.29 * 0.02 * unit, "inside the ring")
        -- Off the plane by half a step at most.
        expect.truthy(norm(from) < math.sqrt((1.91 * 0.02) ^ 2 + (0.51 * step) ^ 2) * unit, "outside")
        for k = 1, 3 do expect.near(one.vector[k], -0.6 * from[k] / norm(from), 1e-6) end
    end
end)

test("options count before what the fidelity says", function()
    local literal = kinds_of((with_curves(style_of{ fidelity = "thesis" })))
    local wide = kinds_of((with_curves(style_of{ fidelity = "thesis" }, { ring = 0.04, lead = 0.03 })))
    expect.truthy(wide.gather > 2 * literal.gather)
    local style = with_curves(style_of{ fidelity = "thesis" })
    local told = style:curves()[3]:options()
    for _, option in ipairs{ "ring", "free", "grip", "spread", "ragged" } do expect.equal(told[option], 0) end
    expect.near(told.lead, 0.5 * style:stats().step)
    expect.equal(told.tail_length, nil)
    expect.equal(style:curves()[2]:options().ramp, 0)
    expect.equal(style:curves()[1]:options().clearance, 0)
    style:curves()[3]:set{ ring = 0.04, lead = 0.03 }
    expect.equal(kinds_of(style).gather, wide.gather)
    local function field_of(options)
        local one = with_curves(style_of(options))
        return one:field(one:at{ azimuth = 100, elevation = 30, lift = 0.05 })
    end
    local plain = field_of{ fidelity = "thesis" }
    expect.near(field_of{ fidelity = "thesis", tension = 0, boundary = "thesis" }, plain, 0)
    expect.truthy(norm{ field_of{ fidelity = "thesis", tension = 0.5 }[1] - plain[1], 0, 0 } > 1e-4)
    expect.truthy(norm{ field_of{ fidelity = "thesis", boundary = "zero_flux" }[1] - plain[1], 0, 0 } > 1e-9)
end)

test("hair of the thesis takes options of growth too, and refuses what has no effect", function()
    local style = with_curves(style_of{ fidelity = "thesis" })
    local hair = style:grow{ count = 300 }
    expect.equal(hair:hash(), style:grow{ count = 300, roots = "steps", avoid = false, variation = 0,
        lift = 0, max_turn = 180 }:hash())
    for _, options in ipairs{ { roots = "poisson" }, { avoid = true }, { length = 0.05 }, { lift = 0.2 } } do
        options.count = 300
        expect.truthy(style:grow(options):hash() ~= hair:hash())
    end
    expect.truthy(#style:grow{ count = 300, avoid = true, layer = 0.01 } > 0)
    for _, option in ipairs{ "clearance", "layer", "ramp" } do
        expect.error(function() style:grow{ count = 300, [option] = 0.01 } end, "avoid = true")
    end
    expect.error(function() style:add_stream{ fidelity = "thesis" } end, "fidelity")
    expect.error(function() style_of{ fidelity = "literal" } end, "thesis")
end)

test("a grid too coarse for the ring says what to do", function()
    local function thin(ring)
        local style = style_of{ fidelity = "thesis", resolution = 1000 }
        return with_curves(style, { radius = 0.001, ring = ring })
    end
    expect.error(thin, "give the tie a radius of at least one step")
    expect.truthy(thin(0.1))
end)

test("files and scenes keep the fidelity, and so does undo", function()
    local style = with_curves(style_of{ fidelity = "thesis" }, { grip = 2 })
    local path = test.file("style.json")
    assert(style:save(path))
    local again = assert(lissom.load_style(path, head))
    expect.equal(again:stats().fidelity, "thesis")
    expect.equal(again:grow{ count = 200 }:hash(), style:grow{ count = 200 }:hash())
    -- Curves that are added later are of it, too.
    expect.equal(#with_curves(again):constraints(), #with_curves(style):constraints())

    local scene, plain = lissom.scene{}, lissom.scene{}
    scene:add("head", head)
    scene:add("hair", style_of{ fidelity = "thesis" })
    plain:add("head", head)
    plain:add("hair", style_of{ tension = 0, boundary = "thesis" })
    expect.truthy(scene:hash() ~= plain:hash())
    local before = scene:hash()
    scene:step("curves", function() with_curves(scene:get("hair")) end)
    local after, hair = scene:hash(), scene:get("hair"):grow{ count = 200 }:hash()
    scene:undo()
    expect.equal(scene:hash(), before)
    scene:redo()
    expect.equal(scene:hash(), after)
    expect.equal(scene:get("hair"):grow{ count = 200 }:hash(), hair)
    local file = test.file("hair.lissom")
    assert(scene:save(file))
    local loaded = assert(lissom.load_scene(file))
    expect.equal(loaded:hash(), after)
    expect.equal(loaded:get("hair"):stats().fidelity, "thesis")
    expect.equal(loaded:get("hair"):grow{ count = 200 }:hash(), hair)
end)

test("the default is what it was, whether or not it is named", function()
    local plain, named = with_curves(style_of{}), with_curves(style_of{ fidelity = "default" })
    expect.equal(plain:stats().fidelity, "default")
    expect.equal(plain:grow{ count = 200 }:hash(), named:grow{ count = 200 }:hash())
    expect.equal(plain:grow{ count = 200 }:hash(), plain:grow{ count = 200, length = 0.25, variation = 0.1,
        roots = "poisson", avoid = true, clearance = 0.002, layer = 0.012, ramp = 0.03, lift = 0.15,
        max_turn = 88 }:hash())
end)
