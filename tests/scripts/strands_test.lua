local lissom = require "lissom"

local function path(extension) return test.file("hair" .. extension) end

local function lawn(count, points)
    local all, counts = {}, {}
    for s = 1, count do
        for k = 0, points - 1 do
            all[#all + 1] = { 0.004 * (s % 20) + 0.0005 * k * k, 0.01 * k, 0.004 * math.floor(s / 20) }
        end
        counts[s] = points
    end
    return lissom.strands{ points = all, counts = counts }
end
local before = lawn(200, 12)

test("upright strands on a grid, with a little bend", function()
    local hair = lawn(200, 12)
    expect.equal(#hair, 200)
    expect.equal(tostring(hair), "lissom.Strands: 200 strands, 2400 points")
    expect.equal(hair:strand(3):count(), 12)
    expect.near({ hair:strand(3):get(1) }, { 0.012, 0, 0 }, 1e-7)
    expect.equal(hair:points():count(), 2400)
    expect.equal(hair:stats().max_points, 12)
    expect.equal(hair:stats().not_finite, 0)
end)

test("operators change the strands in place and return them; roots stay", function()
    local hair = before:copy()
    expect.truthy(rawequal(hair:clump{ clumps = 20 }:noise{}:smooth{}:taper{}, hair))
    expect.truthy(hair:hash() ~= before:hash())
    for s = 1, #hair do
        expect.near({ hair:strand(s):get(1) }, { before:strand(s):get(1) }, 0)
    end
    hair:trim{ length = 0.05, plane = { point = { 0, 0.04, 0 }, normal = { 0, 1, 0 } } }
    expect.truthy(hair:stats().max_length < 0.0501)
    expect.truthy(hair:bounds().max[2] < 0.0401)
    expect.equal(hair:resample{ count = 5 }:points():count(), 1000)
end)

test("a prefix stays the prefix", function()
    local options = { clumps = 20, strength = 0.8 }
    expect.equal(before:select{ first = 50 }:clump(options):hash(),
        before:copy():clump(options):select{ first = 50 }:hash())
end)

test("choosing", function()
    expect.equal(#before:select{ strands = { 5, 2 } }, 2)
    expect.equal(#before:select{ where = function(_, x) return x < 0.003 end }, 10)
    expect.failure("out_of_range", before.select, before, { group = "fringe" })
    expect.error(function() before:select{ where = function() error("'where' fails") end } end, "'where'")
    expect.equal(#before:copy():append(before), 400)
end)

test("files", function()
    for _, extension in ipairs{ ".hair", ".data", ".usda" } do
        local saved, report = before:save(path(extension))
        expect.truthy(rawequal(saved, before))
        expect.equal(#report, 0)
        local back = assert(lissom.load_strands(path(extension)))
        expect.near(back:points():table(), before:points():table(), 0)
    end
    for _, extension in ipairs{ ".rib", ".glb", ".gltf", ".obj" } do
        assert(before:save(path(extension)))
    end
    local odd = lissom.strands{ points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } }, counts = { 1, 2 } }
    local _, report = odd:save(path(".hair"), { up = "z", unit = 0.01 })
    expect.equal(report[1].kind, "strands_too_short")
    expect.near(report[1].strands, { 1 })
    local turned = lissom.load_strands(path(".hair"), { up = "z", unit = 0.01 })
    expect.near({ turned:strand(1):get(2) }, { 1, 1, 0 }, 1e-6)
end)

test("widths and colours go into the files that have them; what is not given stays", function()
    local dyed = before:copy()
    expect.truthy(rawequal(dyed:set_widths{ width = 9e-5, profile = { 1, 0.5 } }, dyed))
    dyed:set_colors{ color = { 0.3, 0.2, 0.1 } }
    assert(dyed:save(path(".hair")))
    expect.truthy(lissom.load_strands(path(".hair")):hash() ~= before:hash())
    expect.equal(dyed:copy():set_widths{ width = 9e-5 }:hash(), dyed:hash())
    expect.truthy(dyed:copy():set_widths{ profile = {} }:hash() ~= dyed:hash())
    local each = {}
    for s = 1, #dyed do each[s] = { s / #dyed, 0, 0 } end
    expect.truthy(dyed:copy():set_colors{ colors = each }:hash() ~= dyed:hash())
    expect.error(function() dyed:set_colors{ colors = { { 1, 0, 0 } } } end, "200 strands")
    expect.error(function() dyed:set_colors{ color = { 1, -1, 0 } } end, "negative")
    expect.error(function() dyed:set_widths{ profile = { 1, -1 } } end, "negative")
    expect.error(function() dyed:set_widths{} end, "'profile'")
    expect.error(function() dyed:set_widths{ width = 1, widths = { 1 } } end, "either")
end)

test("the world's faults and misuse", function()
    expect.failure("file_not_found", lissom.load_strands, path(".hair"))
    expect.failure("unknown_format", before.save, before, path(".abc"))
    expect.error(function() before:strand(201) end, "201")
    expect.error(function() before:clump{ strenght = 1 } end, "strenght")
end)

test("guides stay with the strands, and files that hold ids hold them", function()
    local hair = lawn(200, 12):guides{ count = 10 }
    expect.equal(hair:root(150).guide < 10, true)
    expect.near(hair:root(3).arc, hair:stats().min_length, 1e-3)

           hair:save(path ".usda")
    for _, ending in ipairs{ ".usda", ".ply" } do
        expect.equal(#select(2, hair:save(path(ending))), 0)
        local back = lissom.load_strands(path(ending))
        for _, s in ipairs{ 1, 77, 200 } do expect.equal(back:root(s).guide, hair:root(s).guide) end
    end
    local _, report = hair:save(path ".tfx")
    expect.truthy(report[#report].message:find("guides", 1, true))
    expect.equal(#lissom.load_strands(path ".tfx"), 200)
    expect.equal(#select(2, hair:save(path ".hair")), 1)
    expect.equal(lawn(20, 5):root(1).guide, nil)
end)

test("styling operators change strands in place and keep roots", function()
    local chains = {
        gather = { guides = 10 }, twist = { guides = 10 }, pinch = { guides = 10 },
        curl = { guides = 10, radius = 0.003, wavelength = 0.02 }, wave = { guides = 10, start = 0 },
            frizz = {},
        straighten = {}, rotate = { axis = "x", angle = 20 }, roll = {}, puff = {},
        displace = { offset = { 0.01, 0, 0 } }, set_length = { scale = 1.5 },
        cut = { plane = { point = { 0, 0.05, 0 }, normal = { 0, 1, 0 } } },
    }
    for name, options in pairs(chains) do
        local hair = before:copy()
        expect.truthy(rawequal(hair[name](hair, options), hair), name)
        expect.truthy(hair:hash() ~= before:hash(), name)
        for s = 1, #hair, 17 do expect.near({ hair:strand(s):get(1) }, { before:strand(s):get(1) }, 0) end
        local still = before:copy()
        if name ~= "cut" then
            options.factor = 0
            expect.equal(still[name](still, options):hash(), before:hash(), name)
        end
    end
end)

test("masks are numbers, a function of the root, or a group; others stay", function()
    local half = {}
    for s = 1, 200 do half[s] = s <= 100 and 0 or 1 end
    local by_list = before:copy():rotate{ axis = "x", angle = 30, mask = half }
    local by_function = before:copy():rotate{ axis = "x", angle = 30, mask = function(s) return s > 100 end }
    expect.equal(by_list:hash(), by_function:hash())
    expect.equal(by_list:select{ first = 100 }:hash(), before:select{ first = 100 }:hash())
    expect.failure("invalid_argument", by_list.rotate, by_list, { angle = 30, mask = { 1, 0 } })
    expect.failure("out_of_range", by_list.rotate, by_list, { angle = 30, mask = "fringe" })
    expect.error(function() before:copy():puff{ mask = function() error "no mask" end } end, "no mask")
    expect.error(function() before:cut{} end, "give one of")
end)

test("cuts and culls", function()
    local hair = before:copy():cut{ inside = function(_, y) return 0.04 - y end }
    expect.truthy(hair:bounds().max[2] < 0.0401)
    hair = before:copy():cut{ ellipsoid = { center = { 0, 0, 0 }, radii = { 1, 0.05, 1 } } }
    expect.truthy(hair:bounds().max[2] < 0.0501)
    expect.equal(#before:copy():cull{ mask = function(_, x) return x > 0.003 end }, 10)
    local left = #before:copy():cull{ part = 0.5 }
    expect.truthy(left > 70 and left < 130)
end)

do
    -- Hair for engines: guide sets, cards, and their pictures.

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
        expect.error(function() hair:guide_set{ count = 2 } end, "count")
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
        -- Stray hairs have no card of their own.
        expect.truthy(stats.cards <= 60 and stats.cards >= 55, stats.cards)
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

    test("hair is checked for engines, and what is told mends it", function()
        local _, style, hair = bob()
        expect.equal(#hair:check{ target = "unreal", head = style }.findings, 0)
        local long = hair:select{ first = 50 }:resample{ count = 300 }:set_widths{ width = 0 }
        local found = long:check{ target = "unreal", head = style }
        expect.equal(found.ok, false)
        local codes = {}
        for _, finding in ipairs(found.findings) do codes[finding.code] = finding end
        expect.equal(codes.many_points.count, 50)
        expect.equal(#codes.no_widths.strands, 50)
        expect.truthy(codes.many_points.remedy:find("resample", 1, true))
        long:resample{ count = 64 }:set_widths{ width = 75e-6 }
        expect.equal(long:check{ target = "unreal", head = style }.ok, true)
        local cards = hair:cards{ count = 60, style = style }
        expect.equal(#hair:check{ target = "godot", cards = cards }.findings, 0)
    end)

    test("sparse hair has cards with pictures, however ragged the edge of its cap is", function()
        if not pcall(function() return lissom.bake_cards end) then test.skip("a renderer") end
        local _, style, hair = bob()
        for _, first in ipairs{ 60, 150, 400, 900 } do
            local cards = hair:select{ first = first }:cards{ count = 20, style = style, slots = 4 }
            local preview = lissom.bake_cards{ cards = cards, color = "#8a6a4a", size = 128,
                file = test.file("sparse.png") }
            expect.truthy(preview:face_count() > 0)
        end
    end)

    test("cards have pictures", function()
        if not pcall(function() return lissom.bake_cards end) then test.skip("a renderer") end
        local _, style, hair = bob()
        local cards = hair:cards{ count = 60, style = style, slots = 12 }
        local stats = cards:stats()
        local glb = test.file("cards.glb")
        local preview, ribbons, cap = lissom.bake_cards{ cards = cards, file = test.file("color.png"),
            mesh = glb, flow = test.file("flow.png"), data = test.file("data.png"), size = 256 }
        expect.truthy(preview:face_count() > 1000)
        expect.truthy(cap:face_count() > 50 and cap:face_count() < preview:face_count())
        -- In metres where the hair is, in its colours.
        local found, all = ribbons:bounds(), hair:bounds()
        expect.truthy(#ribbons > 500)
        for k = 1, 3 do expect.truthy(math.abs(found.max[k] - all.max[k]) < 0.02) end
        local again = lissom.load(glb)
        expect.equal(again:face_count(), stats.triangles)
        again:save(test.file("again.glb"))
        expect.error(function() lissom.bake_cards{ cards = cards, file = test.file("color.tiff") } end, "png")
    end)

    test("hair in motion is written into the strands of its set alone, and groups are named", function()
        local _, style, hair = bob(300)
        local set = hair:guide_set{ count = 20 }
        local dynamics = set:dynamics{ head = style }
        local copy = hair:copy()
        expect.equal(dynamics:step(0.1):strands{ into = copy }, copy)
        local order = {}
        for s = 1, #hair do order[s] = #hair + 1 - s end
        local others = hair:select{ strands = order }
        local unchanged = others:hash()
        expect.error(function() dynamics:strands{ into = others } end, "other strands than the set")
        expect.error(function() dynamics:strands{ into = hair:select{ first = 9 } } end, "made of 300")
        expect.equal(others:hash(), unchanged)
        expect.error(function() set:dynamics{ head = style, bound = { "brade" } } end, "no group 'brade'")
    end)

    test("a cap needs a style, and budgets count", function()
        local _, style, hair = bob(300)
        expect.error(function() hair:cards{ cap = true } end, "style")
        -- Stray hairs have no card.
        local made = hair:cards{ count = 20, triangles = 200 }:stats().triangles
        expect.truthy(made <= 200 and made >= 160)
        expect.error(function() hair:cards{ count = 20, triangles = 30 } end, "two triangles")
        expect.truthy(hair:cards{ count = 20, style = style }:stats().triangles >
            hair:cards{ count = 20, style = style, cap = false }:stats().triangles)
    end)
end

-- Hair that follows its head.
do
    local function grown(head, count, length)
        local style = lissom.hairstyle(head, { resolution = 6000 })
        for _, side in ipairs{ -1, 1 } do
            style:add_stream{ points = {
                style:at{ azimuth = 20 * side, elevation = 60, lift = 0.01 },
                style:at{ azimuth = 80 * side, elevation = 20, lift = 0.02 },
                style:at{ azimuth = 95 * side, elevation = -30, lift = 0.02 } } }
        end
        return style:grow{ count = count, length = length }
    end
    local head = lissom.shapes.head{ vertices = 3000 }
    local hair = grown(head, 300, 0.15)

    local function leaning(degrees)
        local bent = head:copy()
        local d = lissom.deformer(bent)
        d:pin(bent:region{ plane = { point = { 0, -0.17, 0 }, normal = { 0, -1, 0 } } })
        local skull = d:add_handle(bent:region{ plane = { point = { 0, 0, 0 }, normal = { 0, 1, 0 } } })
        skull:rotate{ axis = "z", angle = degrees, about = { 0, -0.1, 0 } }
        d:solve()
        return bent
    end

    -- The place of a root on a mesh.
    local function place(mesh, root)
        local corners, p = root.triangle or mesh:face(root.face), { 0, 0, 0 }
        for c = 1, 3 do
            local x, y, z = mesh:position(corners[c])
            for k, value in ipairs{ x, y, z } do p[k] = p[k] + root.bary[c] * value end
        end
        return p
    end

    test("barycentrics of roots lie in their triangle of a quad", function()
        local on_quads = 0
        for s = 1, #hair do
            local root = hair:root(s)
            if root.triangle then on_quads = on_quads + 1 end
            local p = place(head, root)
            for k = 1, 3 do
                expect.truthy(root.bary[k] >= 0)
                expect.near(p[k], root.position[k], 1e-6)
            end
        end
        expect.truthy(on_quads > 200)
        local file = test.file("roots.usda")
        hair:save(file)
        local back = lissom.load_strands(file)
        for _, s in ipairs{ 1, 77, 300 } do
            expect.equal(back:root(s).triangle, hair:root(s).triangle)
        end
    end)

    test("roots stay on the skin of a leaning head and lengths stay", function()
        local bent = leaning(25)
        local moved = hair:follow(bent)
        expect.equal(#moved, #hair)
        for s = 1, #hair, 7 do
            local root = moved:root(s)
            local p = place(bent, root)
            for k = 1, 3 do expect.near(p[k], root.position[k], 1e-6) end
            expect.equal(root.id, hair:root(s).id)
        end
        expect.near(moved:stats().mean_length, hair:stats().mean_length, 0.002 * hair:stats().mean_length)
        expect.equal(hair:follow(head):hash(), hair:hash())
    end)

    test("a head that is deformed in place takes its hair along, frame by frame", function()
        local own = head:copy()
        local short = grown(own, 50, 0.05)
        local follower = short:select{ first = 20 }:follower{ collision = "near" }
        expect.equal(#follower, 20)
        local into = short:copy()
        own:transform{ translate = { 0, 0.5, 0 } }
        expect.equal(follower:follow(own, { into = into }), into)
        expect.equal(#into, 20)
        for s = 1, 20 do
            expect.near(into:root(s).position[2], short:root(s).position[2] + 0.5, 1e-6)
        end
        expect.equal(#short:follow(own, { collision = "none" }), 50)
    end)

    test("hair of a file follows once its head is given", function()
        local file = test.file("follow.usda")
        hair:save(file)
        local back, bent = lissom.load_strands(file), leaning(10)
        expect.error(function() back:follow(bent) end, "rest")
        expect.equal(#back:follow(bent, { rest = head }), #hair)
    end)

    test("misuse of follow has a remedy", function()
        expect.error(function() hair:follow(lissom.shapes.head{ vertices = 4000 }) end, "attach")
        local turned = head:copy()
        for v = 1, #turned do
            local x, y, z = turned:position(v)
            turned:set_position(v, -x, y, z)
        end
        expect.error(function() hair:follow(turned) end, "flip")
        local bald = lissom.strands{ points = { { 0, 0, 0 }, { 0, 1, 0 } }, counts = { 2 } }
        expect.error(function() bald:follow(head) end, "attach")
        expect.error(function() hair:follow(head, { scale = 0 }) end, "scale")
    end)
end

-- ---- Other heads, levels

local function grown_bob()
    local head = lissom.shapes.head{ vertices = 4000 }
    local style, hair = require("presets.bob").grow(head, {}, { count = 1500, resolution = 8000 })
    return head, style, hair
end

test("hair goes to a head of other faces, size and place", function()
    local _, _, hair = grown_bob()
    local other = lissom.shapes.head{ vertices = 3000 }
    other:transform{ scale = { 1.2, 1.1, 1.15 }, translate = { 1, 2, 3 } }
    local scalp = lissom.scalp(other)
    local moved = hair:transfer(scalp)
    expect.equal(#moved, #hair)
    for strand = 1, #moved, 50 do
        local root, point = moved:root(strand), {}
        expect.truthy(root.face and root.face <= other:face_count())
        for k = 1, 3 do point[k] = root.position[k] / scalp:unit() end
        expect.near(other:nearest(point).distance, 0, 1e-5)
    end
end)

test("a shell and fewer strands have the silhouette of the hair, nearly", function()
    local _, style, hair = grown_bob()
    hair:set_widths{ width = 0.002 }:set_colors{ color = { 0.5, 0.3, 0.1 } }
    local shell = hair:shell{ style = style, triangles = 800 }
    expect.truthy(shell:face_count() <= 850)
    expect.truthy(shell:attribute("color"))
    local unit = style:scalp():unit()
    local error = hair:silhouette_error{ mesh = shell, unit = unit }
    expect.truthy(error.mean < 0.3, "the shell is off by " .. error.mean)
    local half = hair:select{ first = math.floor(#hair / 2) }
    local wide = hair:silhouette_error{ strands = half, widen = 2 }
    expect.truthy(wide.mean < hair:silhouette_error{ strands = half }.mean)
    expect.error(function() hair:silhouette_error{} end, "give one level")
end)

test("levels of strands, cards and a shell come in one call, each with its error", function()
    local _, style, hair = grown_bob()
    hair:set_colors{ color = { 0.5, 0.3, 0.1 } }
    local levels = hair:levels{ style = style, width = 0.002, slots = 8,
        cards = { { count = 40, sections = 6 } },
        strands = { { screen_size = 1, points = 12 }, { count = 500 } },
        shell = { triangles = 600 } }
    expect.equal(#levels, 4)
    local kinds = { "strands", "strands", "cards", "shell" }
    for i, level in ipairs(levels) do
        expect.equal(level.kind, kinds[i])
        expect.truthy(level.silhouette.mean <= level.silhouette.worst and level.silhouette.mean < 0.35)
        expect.truthy(level.screen_size > 0 and level.screen_size <= 1)
        expect.equal(level.group, nil)
    end
    expect.equal(#levels[1].strands, #hair)
    expect.equal(#levels[2].strands, 500)
    expect.near(levels[2].widen, #hair / 500, 1e-9)
    expect.truthy(levels[2].strands:root(1).face)
    expect.truthy(#levels[3].cards <= 40 and #levels[3].cards >= 36, #levels[3].cards)
    expect.truthy(levels[3].cards:mesh():attribute("uv"))
    expect.truthy(levels[4].mesh:attribute("color"))
    -- Cards and shell are in the unit of the head, and around it.
    local size = style:scalp():head():size()
    expect.truthy(levels[4].mesh:size() < 2 * size and levels[4].mesh:size() > 0.3 * size)
    expect.truthy(levels[3].cards:mesh():size() < 2 * size)
end)

test("levels by groups, the usual ones, and misuse", function()
    local _, _, hair = grown_bob()
    expect.equal(#hair:select{ first = 300 }:levels{ width = 0.004 }, 7)
    local head = lissom.shapes.head{ vertices = 4000 }
    local _, tails = require("presets.pigtails").grow(head, {}, { count = 800, resolution = 8000 })
    local levels = tails:levels{ width = 0.003, of = "groups", strands = { { count = 80, points = 6 } } }
    expect.equal(#levels, 2)
    for i, level in ipairs(levels) do
        expect.equal(level.group, "tail " .. i)
        expect.near(#level.strands, #tails:select{ group = level.group } / 10, 1)
    end
    expect.error(function() hair:levels{ strands = { { count = 0 } } } end, "count")
    expect.error(function() hair:levels{ strands = { { count = 10000000 } } } end, "the hair has " .. #hair)
    expect.error(function() hair:levels{ cards = { { count = 10000000 } } } end, "count")
    expect.error(function() hair:levels{ shell = { triangles = 10000000 } } end, "triangles")
    expect.error(function() hair:levels{ strands = { {} } } end, "count")
    expect.error(function() hair:levels{ cap = true } end, "style")
    expect.error(function() hair:levels{ strands = { { counts = 3 } } } end, "counts")
    expect.error(function() hair:select{ first = 0 }:levels{} end, "no strands")
end)
