-- Features removed, cloned, kept in files, put onto models and scattered over them.
local lissom = require "lissom"
local models = require "models"
local parts = require "parts"
local put_feature = require "recipes.put_feature"
local scatter = require "recipes.scatter"

local function horned()
    local mesh = lissom.shapes.sphere{ segments = 24, kind = "triangles" }
    for i = 1, #mesh do
        local x, y, z = mesh:position(i)
        if y > 0 then mesh:set_position(i, x, y + 0.8 * math.exp(-14 * (x * x + z * z)), z) end
    end
    return mesh, mesh:region{ sphere = { center = { 0, 1.3, 0 }, radius = 0.85 } }
end

-- Closed and whole, with this genus.
local function expect_whole(mesh, genus)
    expect.truthy(mesh:is_closed())
    expect.equal(mesh:components(), 1)
    expect.equal(mesh:genus(), genus or 0)
end

test("a feature is erased, and put somewhere else", function()
    local ball, horn = horned()
    local before = ball:hash()
    local plain, report = ball:erase(horn)
    expect_whole(plain)
    expect.truthy(plain:bounds().max[2] < 1.03 and plain:bounds().max[2] > 0.97)
    expect.truthy(#report.patch > 20 and report.removed_faces > 100)
    expect.truthy(rawequal(report.patch:mesh(), plain) and rawequal(report.loop:mesh(), ball))
    expect.truthy(report.loop:is_closed())
    expect.truthy(report.ok and report.verdict:find("^good: the patch turns"))
    expect.truthy(report.greatest_around > 0 and report.density == 1)
    local two, merged = ball:clone{ from = horn, to = { 1, 0, 0 }, scale = 0.7 }
    expect_whole(two)
    expect.truthy(two:bounds().max[1] > 1.2 and two:bounds().max[2] > 1.7)
    expect.equal(merged.paste.expected_characteristic, 2)
    expect.equal(ball:hash(), before)
    expect.error(function() ball:erase(ball:region{ vertices = {} }) end, "holds no face")
end)

test("features under a paste are removed first", function()
    local ball, horn = horned()
    local spike = parts.make("spike")
    local paste = lissom.paste{ source = spike.mesh, region = spike.region, feature = spike.feature,
        target = ball, clear = horn,
        placement = { at = { 0, 1.7, 0 }, scale = 0.3, up = spike.up, toward = "z" } }
    paste:optimize()
    local mesh = paste:merge()
    expect_whole(mesh)
    expect.truthy(mesh:bounds().max[2] < 1.65)
    local cleared = lissom.paste{ source = spike.mesh, region = spike.region, feature = spike.feature,
        target = ball, clear = true,
        placement = { at = { 0, 1.7, 0 }, scale = 1, up = spike.up, toward = "z" } }
    cleared:optimize()
    expect_whole((cleared:merge()))
end)

test("a part that is dragged is shown by drafts, and pasted well where it stays", function()
    local ball, horn = horned()
    local target = lissom.shapes.sphere{ segments = 24, radius = 2 }
    local placement = { at = { 2, 0, 0 }, angle = 20, scale = 0.7 }
    local function begun()
        local paste = lissom.paste{ source = ball, region = horn, target = target, placement = placement }
        paste:optimize()
        return paste
    end
    local dragged, plain = begun(), begun()
    for _, at in ipairs{ { 1.9, 0.4, 0.2 }, { 1.7, 0.8, 0.4 } } do
        expect.truthy(dragged:move{ at = at } and plain:move{ at = at })
        local shown, report = dragged:merge{ draft = true }
        expect_whole(shown)
        expect.truthy(report.paste.draft and not report.provenance)
        expect.equal(report.seam.flipped, 0)
    end
    local mesh, report = dragged:merge()
    expect.truthy(not report.paste.draft and report.provenance)
    expect.equal(mesh:hash(), plain:merge():hash())
end)

test("a part is kept in a file with its regions", function()
    local ball, horn = horned()
    local colors = ball:add_attribute{ name = "color", domain = "vertex", width = 4 }
    for i = 1, #colors do colors[i] = 1 end
    local path = test.file("horn.glb")
    local feature = horn:shrink(3)
    assert(lissom.part.save(path, { mesh = ball, region = horn, feature = feature, up = "z", front = "y" }))
    local part = assert(lissom.part.load(path))
    expect.equal(#part.region, #horn)
    expect.equal(#part.feature, #feature)
    expect.equal(#part.mesh, #horn:grow(3))
    expect.truthy(part.mesh:attribute("color"))
    -- The horn, which stood along y, looks forward now.
    expect.near(part.mesh:bounds().max[3], ball:bounds().max[2], 1e-6)
    expect.near(part.up, { 0, 1, 0 })
    -- What was loaded is kept again as it is.
    local again = test.file("again.glb")
    assert(lissom.part.save(again, { mesh = part.mesh, region = part.region, feature = part.feature }))
    local third = assert(lissom.part.load(again))
    expect.equal(third.mesh:hash(), part.mesh:hash())
    expect.equal(third.region:vertices(), part.region:vertices())
    expect.equal(third.feature:vertices(), part.feature:vertices())
    -- Other files and directions are refused.
    local none, message, code = lissom.part.save(test.file("horn.obj"), { mesh = ball, region = horn })
    expect.failure("unsupported", none, message, code)
    assert(ball:save(test.file("ball.glb")))
    none, message, code = lissom.part.load(test.file("ball.glb"))
    expect.failure("unsupported", none, message, code)
    none, message, code = lissom.part.load(test.file("missing.glb"))
    expect.failure("file_not_found", none, message, code)
    expect.error(function() lissom.part.save(path, { mesh = ball, region = horn, front = "y" }) end, "angle")
end)

test("each generated part is put onto a head", function()
    for _, name in ipairs(parts.names) do
        local part, head, options = put_feature.example(name)
        local before = head:hash()
        local mesh, reports = put_feature.make(part, head, options)
        if not mesh then error(name .. ": " .. reports, 0) end
        expect_whole(mesh, name == "handle" and 1 or 0)
        expect.equal(#reports, options.mirror and 2 or 1)
        expect.equal(head:hash(), before)
    end
    expect.error(function() parts.make("tooth") end, "there is no part 'tooth'")
    local part, head = put_feature.example("spike")
    expect.error(function() put_feature.make(part, head, {}) end, "needs the option 'at'")
    expect.error(function() put_feature.make(part, head, { at = "0,1,0", colour = 1 }) end, "unknown option")
end)

test("a mirror image is the other half", function()
    local part, head, options = put_feature.example("ear")
    local box = put_feature.make(part, head, options):bounds()
    expect.near(box.max[1], -box.min[1], 0.01)
end)

test("places are spread evenly, and the first ones stay when there are more", function()
    local ball = lissom.shapes.sphere{ segments = 30, kind = "triangles" }
    local few, spacing = scatter.places(ball, { count = 60, seed = 4 })
    local many = scatter.places(ball, { count = 150, seed = 4 })
    for i = 1, 60 do expect.equal(few[i], many[i]) end
    expect.truthy(few[1][1] ~= scatter.places(ball, { count = 1, seed = 5 })[1][1])
    local least, most = math.huge, 0
    for i, p in ipairs(few) do
        local nearest = math.huge
        for j, q in ipairs(few) do
            local d = math.sqrt((p[1] - q[1]) ^ 2 + (p[2] - q[2]) ^ 2 + (p[3] - q[3]) ^ 2)
            if i ~= j then nearest = math.min(nearest, d) end
        end
        least, most = math.min(least, nearest), math.max(most, nearest)
    end
    -- Of a perfect pattern of triangles all would be 1.
    expect.truthy(least > 0.6 * spacing)
    expect.truthy(most < 1.3 * spacing)
end)

test("parts are scattered: sizes and angles vary, more change no others, refused places are told", function()
    local part, ball, options = scatter.example("spike")
    options.count, options.size = 40, 0.12
    local mesh, report = scatter.make(part, ball, options)
    expect_whole(mesh)
    expect.truthy(#report.refused <= 4)
    for _, one in ipairs(report.refused) do expect.truthy(#one.message > 10 and one.place >= 1) end
    local smallest, largest = math.huge, 0
    for _, scale in ipairs(report.scales) do
        smallest, largest = math.min(smallest, scale), math.max(largest, scale)
    end
    expect.truthy(largest / smallest > 1.2 and largest / smallest < 1.5)
    options.count = 60
    local _, more = scatter.make(part, ball, options)
    for i = 1, 40 do
        expect.equal(more.places[i], report.places[i])
        expect.equal(more.angles[i], report.angles[i])
        expect.equal(more.scales[i], report.scales[i])
    end
    -- Crowded: some have no room. Sizes are those of the spikes' outlines.
    options.size = 0.7
    local crowded, told = scatter.make(part, ball, options)
    expect.truthy(#told.refused > 10)
    expect_whole(crowded)
    -- Open targets keep their border.
    local grid = lissom.shapes.grid{ size = { 4, 4 }, segments = { 40, 40 } }
    local field = scatter.make(part, grid, { count = 20, size = 0.2 })
    expect.equal(#field:boundaries(), 1)
    -- Faces of the target are halved where there is no room for a part; its outline keeps its course.
    expect.near(field:boundaries()[1]:length(), grid:boundaries()[1]:length(), 1e-9)
end)

-- The sum of squares of the angles between neighbouring faces around the vertices of a region.
local function bending(mesh, region)
    local normals, sum = {}, 0
    local function corner(v) return { mesh:position(v) } end
    local function normal(f)
        if not normals[f] then
            local face = mesh:face(f)
            local a, b, c = corner(face[1]), corner(face[2]), corner(face[3])
            local u, w = {}, {}
            for k = 1, 3 do u[k], w[k] = b[k] - a[k], c[k] - a[k] end
            local n = { u[2] * w[3] - u[3] * w[2], u[3] * w[1] - u[1] * w[3], u[1] * w[2] - u[2] * w[1] }
            local length = math.sqrt(n[1] ^ 2 + n[2] ^ 2 + n[3] ^ 2)
            for k = 1, 3 do n[k] = n[k] / length end
            normals[f] = n
        end
        return normals[f]
    end
    local edges = {}
    for f, face in ipairs(mesh:faces()) do
        for k = 1, #face do
            local a, b = face[k], face[k % #face + 1]
            if region:contains(a) and region:contains(b) then
                local key = math.min(a, b) .. " " .. math.max(a, b)
                if edges[key] then
                    local n, m = normal(edges[key]), normal(f)
                    local dot = n[1] * m[1] + n[2] * m[2] + n[3] * m[3]
                    sum = sum + math.acos(math.max(-1, math.min(1, dot))) ^ 2
                end
                edges[key] = f
            end
        end
    end
    return sum
end

-- Models with a feature: its tip, a radius around it that holds it, and how many handles and openings stay.
local features = {
    { "models/spot.obj", { 0.177, 0.954, -0.26 }, 0.28 },
    { "models/spot.obj", { 0.472, 0.709, -0.199 }, 0.33 },
    { "heads/ict_head.obj", { 0, 0.0009, 0.131 }, 0.035 },
    { "heads/african_head.obj", { 0, 0.082, 0.675 }, 0.2 },
}

test("horns, ears and noses of real models are erased", function()
    for _, one in ipairs(features) do
        local mesh = assert(lissom.load(models.path(one[1])))
        local region = mesh:region{ sphere = { center = one[2], radius = one[3] } }
        local plain, report = assert(mesh:erase(region))
        expect.equal(#plain:boundaries(), #mesh:boundaries())
        expect.equal(plain:genus(), mesh:genus())
        expect.equal(plain:components(), mesh:components())
        -- The tip is far from what is left.
        expect.truthy(plain:nearest(one[2]).distance > 0.15 * one[3])
        -- What is far is there to the bit, in its order.
        local far = mesh:region{ sphere = { center = one[2], radius = 2 * one[3] } }:invert():vertices()
        local v = 0
        for _, old in ipairs(far) do
            local x, y, z = mesh:position(old)
            local a, b, c
            repeat
                v = v + 1
                a, b, c = plain:position(v)
            until a == x and b == y and c == z or v == #plain
            expect.truthy(a == x and b == y and c == z)
        end
        expect.truthy(bending(plain, report.patch) < 0.5 * bending(mesh, region))
    end
end)

test("a feature of a real model is cloned and put onto another", function()
    local spot = assert(lissom.load(models.path("models/spot.obj")))
    local bunny = assert(lissom.load(models.path("models/bunny_3k.off")))
    local horn = spot:region{ sphere = { center = { 0.177, 0.954, -0.26 }, radius = 0.28 } }
    local two = assert(spot:clone{ from = horn, to = { 0, 0.55, 0.35 }, scale = 0.8 })
    expect.equal(two:genus(), spot:genus())
    expect.truthy(two:is_closed())
    local paste = assert(lissom.paste{ source = spot, region = horn, target = bunny,
        placement = { at = { -0.03, 0.11, 0.03 }, scale = 0.08 } })
    paste:optimize()
    local mesh = assert(paste:merge())
    expect.equal(#mesh:boundaries(), #bunny:boundaries())
end)
