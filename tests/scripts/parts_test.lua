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
    expect.truthy(report.max_around > 0 and report.density == 1)
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

test("pieces of a ring find a feature and room wherever they are marked", function()
    local ring = lissom.shapes.torus{}
    local ball = lissom.shapes.sphere{ segments = 24, kind = "triangles", radius = 2 }
    for _, piece in ipairs{ { 1, 0.8 }, { 4, 1.1 }, { 7, 0.8 }, { 9, 1.1 }, { 10, 1.3 } } do
        local angle = 0.52 * piece[1]
        local middle = { math.cos(angle), piece[1] / 60, math.sin(angle) }
        local region = ring:region{ sphere = { center = middle, radius = piece[2] } }
        local paste = lissom.paste{ source = ring, region = region, target = ball,
            placement = { at = { 0, 0, 2 }, scale = 0.5 } }
        expect.truthy(paste:loop():is_closed())
    end
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
        -- Faces that turned over beside the seam as it was sewn at first do so no more.
        local seam = report.seam
        expect.truthy(seam.after.max_dihedral < 100 and seam.after.max_dihedral <= seam.before.max_dihedral)
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
    expect.failure("unsupported", lissom.part.save, test.file("horn.obj"), { mesh = ball, region = horn })
    assert(ball:save(test.file("ball.glb")))
    expect.failure("unsupported", lissom.part.load, test.file("ball.glb"))
    expect.failure("file_not_found", lissom.part.load, test.file("missing.glb"))
    expect.error(function() lissom.part.save(path, { mesh = ball, region = horn, front = "y" }) end, "angle")
end)

test("each generated part is put onto a head", function()
    for _, name in ipairs(parts.names) do
        local part, head, options = put_feature.example(name, 3000)
        if name == "handle" then part = parts.make(name, { levels = 2 }) end
        -- Mirror images have a test of their own.
        options.mirror = "none"
        local before = head:hash()
        local mesh, reports = put_feature.make(part, head, options)
        if not mesh then error(name .. ": " .. reports, 0) end
        expect_whole(mesh, name == "handle" and 1 or 0)
        expect.equal(#reports, 1)
        expect.equal(head:hash(), before)
    end
    expect.error(function() parts.make("tooth") end, "there is no part 'tooth'")
    local part, head = put_feature.example("spike", 3000)
    expect.error(function() put_feature.make(part, head, {}) end, "needs the option 'at'")
    expect.error(function() put_feature.make(part, head, { at = "0,1,0", colour = 1 }) end, "unknown option")
end)

test("a mirror image is the other half", function()
    local part, head, options = put_feature.example("ear", 3000)
    expect.equal(options.mirror, "x")
    local mesh, reports = put_feature.make(part, head, options)
    expect_whole(mesh)
    expect.equal(#reports, 2)
    local box = mesh:bounds()
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

test("sharp edges of a box go on beside scattered parts, which stand on them", function()
    local box = lissom.shapes.box{ size = { 2, 2, 2 } }
    local part = parts.make("spike", { segments = 14 })
    local mesh, report = scatter.make(part, box, { count = 16, size = 0.2, candidates = 600 })
    expect_whole(mesh)
    expect.equal(report.placed + #report.refused, 16)
    expect.truthy(report.placed >= 12)
    for _, one in ipairs(report.moved) do expect.truthy(one.place >= 1 and #one.at == 3) end
    -- Corners and points of the edges between them are still there, or inside a part that stands on them.
    local gone = 0
    for x = -1, 1, 2 do
        for y = -1, 1, 2 do
            for k = 0, 40 do
                local z = -1 + k / 20
                for _, p in ipairs{ { x, y, z }, { y, z, x }, { z, x, y } } do
                    local found = mesh:nearest(p[1], p[2], p[3])
                    local q, n = found.position, found.normal
                    local above = (p[1] - q[1]) * n[1] + (p[2] - q[2]) * n[2] + (p[3] - q[3]) * n[3]
                    if found.distance > 0.01 and above > 0 then gone = gone + 1 end
                end
            end
        end
    end
    expect.truthy(gone <= 2)
end)

test("parts on sharp edges and corners of a box are good and bite nothing", function()
    local box = lissom.shapes.box{ size = { 2, 2, 2 } }
    local function pasted(name, at)
        local part = parts.make(name)
        local paste = lissom.paste{ source = part.mesh, region = part.region, feature = part.feature,
            target = box, placement = { at = at, up = part.up, scale = 0.3 } }
        paste:optimize()
        local _, report = paste:merge()
        return report
    end
    local cases = { { "nose", { 1, 1, 1 } }, { "nose", { 1, 1, 0 } }, { "horn", { 1, 0, 0 } },
        { "horn", { 1, 1, 0 } } }
    for _, one in ipairs(cases) do
        local report = pasted(one[1], one[2])
        expect.truthy(report.ok)
        expect.truthy(report.bite.length < 0.3)
    end
end)

test("parts are scattered: sizes and angles vary, more change no others, refused places are told", function()
    local part, _, options = scatter.example("spike")
    local ball = lissom.shapes.sphere{ segments = 20, kind = "triangles" }
    ball:transform{ scale = { 1.5, 1, 1 } }
    options.count, options.size, options.candidates = 16, 0.12, 600
    local mesh, report = scatter.make(part, ball, options)
    expect_whole(mesh)
    expect.truthy(#report.refused <= 1)
    for _, one in ipairs(report.refused) do expect.truthy(#one.message > 10 and one.place >= 1) end
    local smallest, largest = math.huge, 0
    for _, scale in ipairs(report.scales) do
        smallest, largest = math.min(smallest, scale), math.max(largest, scale)
    end
    expect.truthy(largest / smallest > 1.2 and largest / smallest < 1.5)
    options.count = 24
    local _, more = scatter.make(part, ball, options)
    for i = 1, 16 do
        expect.equal(more.places[i], report.places[i])
        expect.equal(more.angles[i], report.angles[i])
        expect.equal(more.scales[i], report.scales[i])
    end
    -- Crowded: some have no room. Sizes are those of the spikes' outlines.
    options.size, options.count = 0.7, 20
    local crowded, told = scatter.make(part, ball, options)
    expect.truthy(#told.refused > 2)
    expect.falsy(told.ok)
    expect.equal(told.placed, 20 - #told.refused)
    local reason = told.reasons[#told.reasons]
    expect.equal(reason.fault, "left out")
    expect.near(reason.value, #told.refused / 20, 1e-12)
    expect.truthy(reason.limit < reason.value and #reason.remedy > 10)
    expect.truthy(told.verdict:find("not good", 1, true) and tostring(told):find(reason.remedy, 1, true))
    expect_whole(crowded)
    -- Open targets keep their border.
    local grid = lissom.shapes.grid{ size = { 4, 4 }, segments = { 20, 20 } }
    local field = scatter.make(part, grid, { count = 8, size = 0.2, candidates = 600 })
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

-- A ball whose vertices are lifted by `lift(x, y, z)` along the way from its centre.
local function lifted(segments, lift)
    local mesh = lissom.shapes.sphere{ segments = segments, kind = "triangles" }
    for i = 1, #mesh do
        local x, y, z = mesh:position(i)
        local s = 1 + lift(x, y, z)
        mesh:set_position(i, s * x, s * y, s * z)
    end
    return mesh
end

-- A bump of a width at a point of the ball.
local function bump(x, y, z, px, py, pz, height, width)
    local square = (x - px) ^ 2 + (y - py) ^ 2 + (z - pz) ^ 2
    return height * math.exp(-square / (width * width))
end

local function nosed(segments)
    return lifted(segments, function(x, y, z) return bump(x, y, z, 0, 0, 1, 0.35, 0.2) end)
end

local function nose_of(mesh)
    return { source = mesh, region = mesh:region{ sphere = { center = { 0, 0, 1.1 }, radius = 0.6 } } }
end

local function paste_nose(options)
    local nose = nose_of(options.source or nosed(24))
    nose.target, nose.placement, nose.clear = options.target, options.placement, options.clear
    local paste = assert(lissom.paste(nose))
    paste:optimize()
    return paste
end

test("clear: what goes lies under the part, and a mouth beside the nose stays", function()
    -- Below the nose a deep furrow and a ridge, within the part's reach of its place.
    local function mouth(x, y, z)
        local along = z > 0 and math.max(0, 1 - (x / 0.4) ^ 2) or 0
        return 0.08 * along * math.sin(14 * (y + 0.5)) * math.exp(-((y + 0.5) / 0.12) ^ 2)
    end
    local face = lifted(60, function(x, y, z) return bump(x, y, z, 0, 0, 1, 0.3, 0.18) + mouth(x, y, z) end)
    local paste = paste_nose{ target = face, clear = true,
        placement = { at = { 0, 0, 1.3 }, scale = 0.75, angle = 0 } }
    local gone, what = paste:clearing()
    expect.truthy(what.faces > 50 and what.area > 0.1)
    expect.near(what.height, 0.3, 0.08)
    local _, image = paste:loop()
    local radius = 0
    for _, p in ipairs(image:points()) do radius = math.max(radius, math.sqrt(p[1] ^ 2 + p[2] ^ 2)) end
    for _, v in ipairs(gone:vertices()) do
        local x, y = face:position(v)
        expect.truthy(math.sqrt(x * x + y * y) < 1.1 * radius)
    end
    local mesh, report = paste:merge()
    expect_whole(mesh)
    expect.equal(report.paste.clearing.faces, what.faces)
    -- Every vertex of the mouth beyond the loop is still there.
    local kept = 0
    for i = 1, #face do
        local x, y, z = face:position(i)
        if z > 0 and y < -1.25 * radius and y > -0.75 and math.abs(x) < 0.35 then
            expect.near(mesh:nearest(x, y, z).distance, 0, 1e-9)
            kept = kept + 1
        end
    end
    expect.truthy(kept > 20)
end)

test("clear: a small shift of the place decides nothing", function()
    local face = lifted(40, function(x, y, z)
        return bump(x, y, z, 0, 0, 1, 0.3, 0.18) + bump(x, y, z, 0, -0.55, 0.83, -0.1, 0.1)
    end)
    local areas = {}
    for _, shift in ipairs{ -0.003, 0, 0.003 } do
        local paste = paste_nose{ target = face, clear = true,
            placement = { at = { shift, 0, 1.3 }, scale = 0.6, angle = 0 } }
        local _, what = paste:clearing()
        areas[#areas + 1] = what.area
        local mesh = paste:merge()
        expect_whole(mesh)
        expect.near(mesh:nearest(0, -0.55 * 0.9, 0.83 * 0.9).distance, 0, 0.03)
    end
    expect.near(areas[1], areas[2], 0.1 * areas[2])
    expect.near(areas[3], areas[2], 0.1 * areas[2])
end)

test("clear: a part stands on the foot of a real horn, whose edges are not bitten", function()
    local cow = assert(lissom.load(models.path("models/cowhead.obj")))
    local tip, most = 1, -math.huge
    for v = 1, #cow do
        local x, y = cow:position(v)
        if y + 0.3 * x > most then tip, most = v, y + 0.3 * x end
    end
    local horn, at = parts.make("horn"), { cow:position(tip) }
    local paste = lissom.paste{ source = horn.mesh, region = horn.region, feature = horn.feature,
        target = cow, clear = true, placement = { at = at, scale = 0.22 * cow:size(), up = horn.up } }
    paste:optimize()
    local gone, what = paste:clearing()
    expect.truthy(what.faces > 500)
    local _, image = paste:loop()
    -- The boundary lies around the foot of what went, not under its tip.
    local outside = cow:region{ vertices = gone:vertices() }:boundaries()[1]
    local far = 0
    for _, p in ipairs(image:points()) do
        local near = math.huge
        for _, q in ipairs(outside:points()) do
            near = math.min(near, math.sqrt((p[1] - q[1]) ^ 2 + (p[2] - q[2]) ^ 2 + (p[3] - q[3]) ^ 2))
        end
        far = math.max(far, near)
    end
    expect.truthy(far < 0.7 * outside:length() / (2 * math.pi))
    local _, report = paste:merge()
    for _, reason in ipairs(report.reasons) do expect.truthy(reason.fault ~= "bite") end
end)

test("clear: the boundary runs around a feature, not through it", function()
    -- A nose with wings that are as wide as the part.
    local face = lifted(60, function(x, y, z)
        return bump(x, y, z, 0, 0, 1, 0.3, 0.16) + bump(x, y, z, 0.24, -0.05, 0.97, 0.16, 0.1)
            + bump(x, y, z, -0.24, -0.05, 0.97, 0.16, 0.1)
    end)
    local paste = paste_nose{ target = face, clear = true,
        placement = { at = { 0, 0, 1.3 }, scale = 0.75, angle = 0 } }
    local _, image = paste:loop()
    local highest = 0
    for _, p in ipairs(image:points()) do
        highest = math.max(highest, math.sqrt(p[1] ^ 2 + p[2] ^ 2 + p[3] ^ 2) - 1)
    end
    expect.truthy(highest < 0.04)
    local mesh, report = paste:merge()
    expect_whole(mesh)
    expect.truthy(report.ok)
end)

test("clear: edges of the target beyond the part are not bitten", function()
    -- A box within the ball, which no part touches.
    local box = lissom.shapes.box{ size = { 0.3, 0.3, 0.3 } }:transform{ translate = { 0, 0, 0.5 } }
    local face = nosed(40)
    face:append(box)
    local paste = paste_nose{ target = face, clear = true,
        placement = { at = { 0, 0, 1.3 }, scale = 0.7, angle = 0 } }
    expect.truthy(paste:clearing())
    local _, report = paste:merge()
    for _, reason in ipairs(report.reasons) do expect.truthy(reason.fault ~= "bite") end
end)

-- The vertex of a face that stands out most, between two heights.
local function tip_between(mesh, low, high)
    local bounds, best, found = mesh:bounds(), -math.huge, 1
    for v = 1, #mesh do
        local x, y, z = mesh:position(v)
        local height = (y - bounds.min[2]) / (bounds.max[2] - bounds.min[2])
        local beside = math.abs(x - bounds.center[1]) / (bounds.max[1] - bounds.min[1])
        if z > best and height > low and height < high and beside < 0.08 then best, found = z, v end
    end
    return { mesh:position(found) }
end

test("clear: noses of real faces, with deep nostrils and beside holes, give way to another", function()
    for _, face in ipairs{ { "heads/ict_generic_neutral.obj", 0.5, 0.8, 0.22 },
        { "heads/WaltHead.obj", 0.4, 0.7, 0.24 }, { "heads/digitalsalon_head.obj", 0.45, 0.7, 0.24 } } do
        local target = assert(lissom.load(models.path(face[1])))
        local at, scale = tip_between(target, face[2], face[3]), face[4] * target:size()
        local nose = parts.make("nose")
        local paste = lissom.paste{ source = nose.mesh, region = nose.region, feature = nose.feature,
            target = target, clear = true, placement = { at = at, scale = scale, up = nose.up } }
        paste:optimize()
        local _, what = paste:clearing()
        expect.truthy(what.height > 0.4 * scale)
        local _, report = paste:merge()
        expect.truthy(report.ok)
    end
end)

test("clear: thin ears with no room beneath are taken as they are", function()
    local target = assert(lissom.load(models.path("models/suzanne_quads.obj")))
    local tip, most = 1, -math.huge
    for v = 1, #target do
        local x = target:position(v)
        if x > most then tip, most = v, x end
    end
    local ear = parts.make("ear")
    local paste = lissom.paste{ source = ear.mesh, region = ear.region, feature = ear.feature,
        target = target, clear = true,
        placement = { at = { target:position(tip) }, scale = 0.35 * target:size(), up = ear.up } }
    paste:optimize()
    expect.truthy(paste:clearing())
    expect.truthy((paste:merge()):vertex_count() > #target)
end)

test("clear: a part that clears nothing has nothing to show", function()
    local paste = paste_nose{ target = nosed(30), placement = { at = { 0, 1, 0 }, scale = 0.5 } }
    expect.equal(paste:clearing(), nil)
end)

test("erase takes nothing beyond the region and its ring, and nothing that it runs around", function()
    local ball = lifted(36, function(x, y, z) return bump(x, y, z, 0, 1, 0, 0.8, 0.25) end)
    -- A band around the horn: the tip is not marked.
    local band = ball:region{ box = { min = { -0.4, 1.15, -0.4 }, max = { 0.4, 1.4, 0.4 } } }
    expect.error(function() assert(ball:erase(band)) end, "runs around")
    expect.error(function() assert(ball:erase(band, { ring = 0 })) end, "runs around")
    for _, ring in ipairs{ 0.2, 0.5, 1 } do
        local marked = ball:region{ sphere = { center = { 0, 1.4, 0 }, radius = 0.62 } }
        local _, report = assert(ball:erase(marked, { ring = ring }))
        local near = {}
        local around = ball:region{ geodesic = { from = marked, radius = report.ring + 1e-9 } }
        for _, v in ipairs(around:vertices()) do near[v] = true end
        for _, v in ipairs(report.loop:vertices()) do expect.truthy(near[v] or marked:contains(v)) end
    end
    local exact = ball:region{ sphere = { center = { 0, 1.4, 0 }, radius = 0.62 } }
    local _, report = assert(ball:erase(exact, { ring = 0 }))
    expect.equal(report.removed_faces, #exact:faces())
end)

test("erase does not cross an edge of the target", function()
    local box = lissom.shapes.box{ segments = { 24, 24, 24 } }
    for i = 1, #box do
        local x, y, z = box:position(i)
        if z > 0.49 then
            box:set_position(i, x, y, z + 0.2 * math.exp(-((x - 0.3) ^ 2 + y * y) / 0.01))
        end
    end
    local marked = box:region{ sphere = { center = { 0.3, 0, 0.5 }, radius = 0.19 } }
    local plain, report = assert(box:erase(marked, { ring = 2 }))
    expect_whole(plain)
    for _, v in ipairs(report.loop:vertices()) do
        local x, _, z = box:position(v)
        expect.truthy(x < 0.5 + 1e-9 and z > 0.5 - 1e-9)
    end
end)

test("a part finds room on a cube of twelve triangles, and its edges are not bitten", function()
    for _, at in ipairs{ { 0.1, 0.1, 0.5 }, { 0.5, 0.1, 0.5 }, { 0.5, 0.5, 0.5 }, { -0.5, 0.2, -0.3 } } do
        for _, polygons in ipairs{ false, true } do
            local cube = lissom.shapes.box()
            if not polygons then cube:triangulate() end
            local paste = paste_nose{ target = cube, placement = { at = at, scale = 0.2 } }
            local mesh, report = paste:merge()
            expect_whole(mesh)
            -- What the part takes of an edge that it stands on is told, and nothing else is wrong.
            local on_edge = at[1] == 0.5 and at[3] == 0.5
            expect.truthy(report.ok or on_edge)
            for _, reason in ipairs(report.reasons) do expect.equal(reason.fault, "bite") end
            local _, image = paste:loop()
            -- Away from the part the cube's edges are where they were.
            for _, axis in ipairs{ 1, 2, 3 } do
                for step = -10, 10 do
                    for _, corner in ipairs{ { 0.5, 0.5 }, { 0.5, -0.5 }, { -0.5, 0.5 }, { -0.5, -0.5 } } do
                        local p = { corner[1], corner[2] }
                        table.insert(p, axis, step / 20)
                        local near = math.huge
                        for _, q in ipairs(image:points()) do
                            near = math.min(near, (p[1] - q[1]) ^ 2 + (p[2] - q[2]) ^ 2 + (p[3] - q[3]) ^ 2)
                        end
                        local inside = (p[1] - at[1]) ^ 2 + (p[2] - at[2]) ^ 2 + (p[3] - at[3]) ^ 2 < 0.15 ^ 2
                        if near > 0.05 ^ 2 and not inside then
                            expect.near(mesh:nearest(p[1], p[2], p[3]).distance, 0, 1e-9)
                        end
                    end
                end
            end
        end
    end
end)

test("a part that is dragged over a coarse target finds room everywhere, whatever the way", function()
    local cube = lissom.shapes.box():triangulate()
    local paste = paste_nose{ target = cube, placement = { at = { 0, 0, 0.5 }, scale = 0.15 } }
    for step = 1, 8 do
        assert(paste:move{ at = { 0.06 * step, 0.03 * step, 0.5 }, search = false })
        expect.truthy(#assert(paste:draft()) > 50)
    end
    assert(paste:move{ at = { 0, 0, 0.5 } })
    local again = paste_nose{ target = cube, placement = { at = { 0, 0, 0.5 }, scale = 0.15 } }
    assert(again:move{ at = { 0, 0, 0.5 } })
    expect.equal(paste:merge():face_count(), again:merge():face_count())
end)

test("without a way the part's up is the target's, as far as the surface allows", function()
    local ball = lissom.shapes.sphere{ segments = 40, radius = 3, kind = "triangles" }
    local _, side = paste_nose{ target = ball, placement = { at = { 3, 0, 0 }, scale = 0.8 } }:merge()
    expect.equal(side.paste.upright, true)
    expect.equal(side.paste.angle_chosen, false)
    expect.near(side.paste.angle, 0, 1e-9)
    local _, top = paste_nose{ target = ball, placement = { at = { 0, 3, 0 }, scale = 0.8 } }:merge()
    expect.equal(top.paste.upright, false)
    expect.equal(top.paste.angle_chosen, true)
    local placement = { at = { 3, 0, 0 }, scale = 0.8, angle = 30 }
    local _, turned = paste_nose{ target = ball, placement = placement }:merge()
    expect.equal(turned.paste.upright, false)
end)

test("a feature that is sought takes the open boundaries around it", function()
    local mesh = nosed(40)
    local holed = mesh:remove(mesh:region{ sphere = { center = { 0.22, 0, 1.05 }, radius = 0.09 } })
    holed = holed:remove(holed:region{ sphere = { center = { -0.22, 0, 1.05 }, radius = 0.09 } })
    expect.equal(#holed:boundaries(), 2)
    local ball = lissom.shapes.sphere{ segments = 40, radius = 3, kind = "triangles" }
    local paste = paste_nose{ source = holed, target = ball, placement = { at = { 3, 0, 0 } } }
    local pasted = paste:merge()
    expect.equal(#pasted:boundaries(), 2)
    expect.equal(pasted:components(), 1)
end)

test("scatter: parts that would cross are made smaller, or left out, or counted", function()
    -- Mushrooms: their caps are much wider than their stems.
    local cap = lifted(24, function(x, y, z) return bump(x, y, z, 0, 1, 0, 1.2, 0.25) end)
    for i = 1, #cap do
        local x, y, z = cap:position(i)
        if y > 1.5 then
            local wide = 1 + 9 * math.min(1, (y - 1.5) / 0.3)
            cap:set_position(i, wide * x, y, wide * z)
        end
    end
    local ball = lissom.shapes.sphere{ segments = 30, radius = 3, kind = "triangles" }
    local function scattered(crossings, gap)
        return lissom.scatter{ source = cap, target = ball, crossings = crossings, scales = { 0.6 },
            region = cap:region{ box = { min = { -9, 0.7, -9 }, max = { 9, 9, 9 } } },
            feature = cap:region{ box = { min = { -9, 1.15, -9 }, max = { 9, 9, 9 } } },
            at = { { 0, 0, 3 }, { gap, 0, 3 } } }
    end
    local _, kept = scattered("keep", 1.3)
    expect.equal(#kept.refused, 0)
    expect.truthy(kept.crossings > 0)
    local out, left = scattered("leave out", 1.3)
    expect.equal(#left.refused, 1)
    expect.equal(left.refused[1].place, 2)
    expect.truthy(left.refused[1].message:find("place 1"))
    expect.equal(#out:self_intersections(), 0)
    local small, shrunk = scattered("shrink", 1.3)
    expect.equal(#shrunk.refused + #shrunk.shrunk, 1)
    expect.equal(#small:self_intersections(), 0)
    local _, apart = scattered("shrink", 9)
    expect.equal(#apart.refused + #apart.shrunk + apart.crossings, 0)
end)

test("scatter: there is room on a cube of twelve triangles", function()
    local nose = nose_of(nosed(30))
    nose.target, nose.scales = lissom.shapes.box():triangulate(), { 0.08 }
    nose.at = { { 0.2, 0.2, 0.5 }, { -0.2, -0.2, 0.5 }, { 0.5, 0, 0 }, { 0, -0.5, 0.1 }, { 0.5, 0.3, 0.5 } }
    local mesh, report = lissom.scatter(nose)
    expect.equal(#report.refused, 0)
    expect_whole(mesh)
end)

test("a target without texture coordinates has 0, 0 after a paste, and a warning names it", function()
    local part = nosed(24)
    part:parameterize{ region = part:region{ plane = { point = { 0, 0, 0 }, normal = { 0, 0, 1 } } } }
    local uv = part:attribute("uv")
    for i = 1, #uv do if uv[i] ~= uv[i] then uv[i] = 0.5 end end
    local ball = lissom.shapes.sphere{ segments = 24, kind = "triangles" }
    local paste = paste_nose{ source = part, target = ball, placement = { at = { 0, 0, 1 }, scale = 0.5 } }
    local mesh, report = paste:merge()
    local values, zeros = mesh:attribute("uv"), 0
    for i = 1, #values do
        expect.truthy(values[i] == values[i])
        if values[i] == 0 then zeros = zeros + 1 end
    end
    expect.truthy(zeros > 0 and zeros < #values)
    expect.truthy(table.concat(report.warnings, "\n"):find("the target has no texture coordinates", 1, true))
end)
