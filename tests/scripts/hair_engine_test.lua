-- Hair for engines: guide sets, cards, and their pictures.
local lissom = require "lissom"

local function bob(count)
    local head = lissom.shapes.head{ vertices = 4000 }
    return head, require("presets.bob").grow(head, {}, { count = count or 600, resolution = 8000 })
end

test("guides rebuild their strands, by number, by lock", function()
    local _, _, hair = bob()
    local set = hair:guide_set{ count = 60 }
    expect.equal(#set, 60)
    expect.equal(#set:guides(), 60)
    local made = set:rebuild()
    expect.equal(#made, #hair)
    for s = 1, #hair, 37 do
        local a, b = hair:root(s).position, made:root(s).position
        for k = 1, 3 do expect.near(a[k], b[k], 1e-5) end
    end
    expect.truthy(set:error().rms < 0.02, set:error().rms)
    expect.truthy(hair:guide_set{ count = 240 }:error().rms < set:error().rms)
    local weights = set:weights(5)
    expect.near(weights.weights[1] + weights.weights[2] + weights.weights[3], 1, 1e-5)
    expect.error(function() set:weights(#hair + 1) end, "no such strand")
    expect.error(function() hair:guide_set{ of = "groups" } end, "no groups")
    expect.equal(#hair:guides{ count = 25 }:guide_set{ of = "locks" }, 25)
end)

test("moved guides take the strands along, and others are refused", function()
    local _, _, hair = bob()
    local set = hair:guide_set{ count = 40, points = 12 }
    local moved = set:guides():transform{ translate = { 0, 0.1, 0 } }
    local rest, made = set:rebuild(), set:rebuild{ guides = moved }
    for s = 1, #hair, 51 do
        expect.near(made:root(s).position[2] - rest:root(s).position[2], 0.1, 1e-5)
    end
    expect.error(function() set:rebuild{ guides = hair } end, "another number of points")
end)

test("a guide file has a header that engines read", function()
    local _, _, hair = bob()
    hair:guide_set{ count = 30, points = 8 }:save(test.file("bob.guides"))
    local file = io.open(test.file("bob.guides"), "rb")
    local bytes = file:read("*a")
    file:close()
    expect.equal(bytes:sub(1, 8), "LSMHAIRG")
    expect.equal(#bytes % 16, 0)
end)

test("cards stand for the hair and stay out of the head", function()
    local head, style, hair = bob()
    local cards = hair:cards{ count = 60, style = style, slots = 12 }
    local stats = cards:stats()
    expect.equal(stats.cards, 60)
    expect.truthy(stats.slots <= 13)
    expect.truthy(stats.covered > 0.8, stats.covered)
    local mesh = cards:mesh()
    expect.equal(mesh:face_count(), stats.triangles)
    local positions = mesh:positions()
    local inside = 0
    for i = 1, #positions, 3 do
        local p = { positions[i], positions[i + 1], positions[i + 2] }
        local near = head:nearest(p)
        local out = 0
        for k = 1, 3 do out = out + (p[k] - near.position[k]) * near.normal[k] end
        if out < -1e-3 then inside = inside + 1 end
    end
    expect.truthy(inside <= 0.01 * #positions / 3, inside)
end)

test("cards have pictures", function()
    if not pcall(function() return lissom.bake_cards end) then test.skip("a renderer") end
    local _, style, hair = bob()
    local cards = hair:cards{ count = 60, style = style, slots = 12 }
    local stats = cards:stats()
    local glb = test.file("cards.glb")
    local preview = lissom.bake_cards{ cards = cards, file = test.file("color.png"), mesh = glb,
        flow = test.file("flow.png"), data = test.file("data.png"), size = 256 }
    expect.truthy(preview:face_count() > 1000)
    local again = lissom.load(glb)
    expect.equal(again:face_count(), stats.triangles)
    again:save(test.file("again.glb"))
    expect.error(function() lissom.bake_cards{ cards = cards, file = test.file("color.tiff") } end, "png")
end)

test("a cap needs a style, and budgets count", function()
    local _, style, hair = bob(300)
    expect.error(function() hair:cards{ cap = true } end, "style")
    expect.equal(hair:cards{ count = 20, triangles = 200 }:stats().triangles, 200)
    expect.error(function() hair:cards{ count = 20, triangles = 30 } end, "two triangles")
    expect.truthy(hair:cards{ count = 20, style = style }:stats().triangles >
        hair:cards{ count = 20, style = style, cap = false }:stats().triangles)
end)
