local lissom = require "lissom"
local models = require "models"

local function bar()
    local mesh = lissom.shapes.bar{ across = 2, along = 16 }
    local deformer = lissom.deformer(mesh)
    return mesh, deformer, deformer:add_handle(mesh:region("bottom")), deformer:add_handle(mesh:region("top"))
end

test("nothing moves without a reason, to the bit", function()
    local mesh, deformer = bar()
    local rest = mesh:hash()
    expect.truthy(rawequal(deformer:solve(), mesh))
    expect.equal(mesh:hash(), rest)
    expect.truthy(rawequal(deformer:preview(), mesh))
    expect.equal(mesh:hash(), rest)
end)

test("handles are exact, the rest follows; there and back is rest", function()
    local mesh, deformer, _, top = bar()
    local rest = mesh:hash()
    top:translate(0, 1, 0)
    deformer:solve()
    expect.near(mesh:region("top"):center(), { 0, 3.5, 0 }, 1e-12)
    expect.near(mesh:region("bottom"):center(), { 0, -2.5, 0 }, 1e-12)
    top:translate(0, -1, 0)
    deformer:solve()
    expect.equal(mesh:hash(), rest)
end)

test("a global similarity is reproduced", function()
    local mesh, deformer = bar()
    for _, handle in ipairs(deformer:handles()) do
        handle:set{ rotate = { axis = "z", angle = 90, about = { 0, 0, 0 } }, translate = { 1, 2, 3 } }
    end
    local wanted = mesh:copy():transform{ rotate = { axis = "z", angle = 90 }, translate = { 1, 2, 3 } }
    deformer:solve()
    local a, b = mesh:positions(), wanted:positions()
    for i = 1, #a do expect.near(a[i], b[i], 1e-9) end
end)

test("moves accumulate about the handle's present center; set is absolute; degrees", function()
    local _, _, _, top = bar()
    top:translate(1, 0, 0):rotate{ axis = "y", angle = 90 }
    expect.near(top:center(), { 1, 2.5, 0 })
    top:rotate{ axis = "z", angle = 180, about = { 0, 2.5, 0 } }
    expect.near(top:center(), { -1, 2.5, 0 })
    top:scale(2)
    expect.near(top:center(), { -1, 2.5, 0 })
    top:scale({ 3, 1, 1 }, { about = { 0, 0, 0 } })
    expect.near(top:center(), { -3, 2.5, 0 })
    top:set{ rotate = { axis = "y", angle = 90 } }
    expect.near(top:center(), { 0, 2.5, 0 })
    expect.near(top:matrix()[1], { 0, 0, 1, 0 })
    top:reset()
    expect.near(top:matrix()[1], { 1, 0, 0, 0 }, 0)
    top:set_matrix{ { 1, 0, 0, 5 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } }
    expect.near(top:center(), { 5, 2.5, 0 })
end)

test("reset to the bit, constraints included", function()
    local mesh, deformer, _, top = bar()
    local rest = mesh:hash()
    top:translate(5, 0, 0)
    local v = mesh:nearest(0.5, 0, 0).vertex
    deformer:constrain{ vertex = v, position = { 1, 0, 0 } }
    deformer:solve()
    expect.near({ mesh:position(v) }, { 1, 0, 0 }, 0)
    expect.truthy(rawequal(deformer:reset(), deformer))
    expect.equal(mesh:hash(), rest)
    deformer:constrain{ vertex = v, gradient = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }
    deformer:constrain{ vertex = v }
end)

test("handles: equality, removal, closing", function()
    local mesh, deformer, _, top = bar()
    expect.truthy(deformer:handles()[2] == top and deformer:handles()[1] ~= top)
    expect.truthy(top:region() == mesh:region("top"))
    local stats = deformer:stats()
    expect.equal(stats.region_vertices, #mesh)
    top:remove()
    expect.error(function() top:translate(1, 0, 0) end, "[handle_removed]")
    expect.equal(#deformer:handles(), 1)
end)

test("outside the region nothing moves", function()
    local mesh = lissom.shapes.cactus{ vertices = 2000 }
    local region = mesh:region("left_arm"):grow(2)
    local deformer = lissom.deformer(mesh, { region = region, local_size = "scale", second = "poisson" })
    deformer:add_handle(region:minus(region:shrink(1)))
    deformer:add_handle(mesh:region("left_tip")):rotate{ axis = "x", angle = 40 }
    local outside = region:invert():vertices()
    local before = mesh:copy()
    deformer:solve()
    for _, i in ipairs(outside) do
        expect.near({ mesh:position(i) }, { before:position(i) }, 0)
    end
    expect.truthy(mesh ~= before)
end)

test("the basis gives the preview", function()
    local mesh, deformer, _, top = bar()
    top:translate(0.3, 0.2, 0.1):rotate{ axis = "x", angle = 30 }
    deformer:preview()
    local basis = deformer:basis()
    local i = basis.vertices[100]
    local x, y, z = basis.fixed:get(100)
    for h, handle in ipairs(basis.handles) do
        local w = { basis.weights[h]:get(100) }
        local m = handle:matrix()
        for k = 1, 4 do
            x, y, z = x + m[1][k] * w[k], y + m[2][k] * w[k], z + m[3][k] * w[k]
        end
    end
    expect.near({ mesh:position(i) }, { x, y, z }, 1e-9)
    expect.error(function() basis.fixed[1] = 0 end, "this buffer can only be read")
end)

test("every value of every option works", function()
    for _, options in ipairs{
        { second = "laplacian" }, { local_size = "scale" }, { coherence = 2 }, { weights = "uniform" },
        { displacement = 0.1 }, { degenerate_threshold = 1e4 }, { fidelity = "thesis" },
        { fidelity = "thesis", second = "blend" },
    } do
        local mesh = lissom.shapes.bar{ across = 2, along = 8 }
        local deformer = lissom.deformer(mesh, options)
        deformer:add_handle(mesh:region("bottom"))
        deformer:add_handle(mesh:region("top"), { gradient = false }):translate(0.5, 0, 0)
        expect.truthy(deformer:solve())
    end
end)

test("comparison methods: exact handles, preview as solve, no basis", function()
    local mesh
    for _, method in ipairs{ "naive", "rotation_estimate", "similarity", "geodesic", "harmonic", "frames" } do
        mesh = lissom.shapes.bar{ across = 2, along = 16 }
        local rest = mesh:hash()
        local deformer = lissom.deformer(mesh, { method = method })
        deformer:add_handle(mesh:region("bottom"))
        local top = deformer:add_handle(mesh:region("top")):rotate("z", 40):translate(0.5, 0, 0)
        deformer:solve()
        local solved = mesh:hash()
        expect.near(mesh:region("top"):center(), { 0.5, 2.5, 0 }, 1e-12)
        deformer:preview()
        expect.equal(mesh:hash(), solved)
        top:reset()
        deformer:solve()
        expect.equal(mesh:hash(), rest)
        expect.truthy(expect.failure("unsupported", deformer.basis, deformer).message:find(method, 1, true))
        for name, value in pairs{ local_size = "scale", second = "poisson", coherence = 2, displacement = 0.3,
            degenerate_threshold = 1e4, refine = 1 } do
            expect.error(function()
                lissom.deformer(mesh, { method = method, [name] = value })
            end, name .. "' does not apply to method '" .. method)
        end
    end
    expect.error(function()
        lissom.deformer(mesh, { method = "naive", fidelity = "thesis" })
    end, "does not apply to method 'naive'")
    lissom.deformer(mesh, { method = "harmonic", weights = "uniform" })
    expect.error(function() lissom.deformer(mesh, { method = "geodesic", weights = "uniform" }) end,
        "weights")
end)

test("misuse", function()
    local mesh, deformer, _, top = bar()
    expect.error(function() deformer:add_handle(mesh:region("top"):grow()) end, "[handle_overlap]")
    do -- which handles meet is said, by their numbers
        local stick = lissom.shapes.bar()
        local three = lissom.deformer(stick)
        three:add_handle(stick:region("bottom"))
        three:add_handle(stick:region("top"))
        local count = #stick:region("top")
        expect.error(function()
            three:add_handle(stick:region("top"):grow())
        end, "handle 3 (" .. #stick:region("top"):grow() .. " vertices)")
        expect.error(function()
            three:add_handle(stick:region("top"):grow())
        end, "handle 2 (" .. count .. " vertices)")
    end
    do -- every part that nothing holds is named, by one vertex
        local parts = lissom.shapes.box()
        parts:append(lissom.shapes.box():transform{ translate = { 5, 0, 0 } })
        parts:append(lissom.shapes.box():transform{ translate = { 9, 0, 0 } })
        local loose = lissom.deformer(parts)
        local first = parts:region{ fraction = { max = { 0.2 } } }
        loose:add_handle(first)
        local problem = expect.failure("unconstrained", loose.solve, loose)
        expect.truthy(problem.message:find("2 connected parts, those of vertices 9 and 17", 1, true))
        expect.near(problem.elements.ids, { 9, 17 })
        -- A handle that holds a vertex of each takes them along.
        loose = lissom.deformer(parts)
        loose:add_handle(first:union(parts:region{ vertices = { 9, 17 } })):translate(0, 1, 0)
        assert(loose:solve())
        expect.near(parts:bounds().min[2], lissom.shapes.box():bounds().min[2] + 1, 1e-9)
    end
    expect.error(function() deformer:add_handle(mesh:region{ vertices = {} }) end, "[region_empty]")
    expect.error(function() top:scale(0) end, "[singular_transform]")
    expect.error(function() lissom.deformer(mesh, { coherence = 3 }) end, "integer from 1 to 2 expected")
    expect.error(function()
        lissom.deformer(mesh, { methods = "x" })
    end, "unknown option 'methods' of 'deformer'")
    expect.error(function()
        deformer:add_handle(mesh:region("top"), { strength = 1 })
    end, "unknown option 'strength' of 'add_handle'")
    expect.error(function()
        deformer:constrain{ vertex = 1, faces = 1 }
    end, "unknown option 'faces' of 'constrain'")
    expect.error(function() deformer:aply() end, "no method 'aply'")
    local part = lissom.deformer(mesh, { region = mesh:region("top") })
    expect.error(function() part:add_handle(mesh:region("bottom")) end, "[handle_outside_region]")
    local other = lissom.shapes.bar{ across = 2, along = 16 }
    expect.error(function() deformer:add_handle(other:region("top")) end, "[topology_mismatch]")
end)

test("data that cannot be solved", function()
    local mesh = lissom.shapes.bar{ across = 2, along = 8 }
    local deformer = lissom.deformer(mesh)
    expect.failure("unconstrained", deformer.solve, deformer)
end)

test("an older topology", function()
    local mesh, deformer, _, top = bar()
    mesh:triangulate()
    expect.error(function() deformer:solve() end, "[topology_mismatch]")
    expect.error(function() top:translate(1, 0, 0) end, "[topology_mismatch]")
end)

test("a mesh that was moved around the region: the result would tear, so nothing is written", function()
    local mesh = lissom.shapes.bar{ across = 2, along = 16 }
    local deformer = lissom.deformer(mesh, { region = mesh:region{ fraction = { min = { nil, 0.5, nil } } } })
    local top = deformer:add_handle(mesh:region("top"))
    top:translate(0, 1, 0)
    deformer:solve()
    mesh:transform{ translate = { 3, 0, 0 } }
    local moved = mesh:hash()
    for _, name in ipairs{ "solve", "preview", "reset", "rebase" } do
        expect.error(function()
            local result = deformer[name](deformer)
            return result
        end, "the mesh has changed around the region")
    end
    expect.error(function() deformer:bake{ times = { 0 }, pose = function() end } end, "[topology_mismatch]")
    expect.error(function() deformer:subdivided_mesh() end, "[topology_mismatch]")
    expect.equal(mesh:hash(), moved)
    mesh:transform{ translate = { -3, 0, 0 } }
    expect.truthy(deformer:solve())
end)

test("a matrix tells how far a handle has turned, also to another handle and after a reset", function()
    for _, angle in ipairs{ 30, 180, 200, 360, 540, -400 } do
        local _, deformer, _, top = bar()
        top:rotate{ axis = "y", angle = angle }
        local matrix, solved = top:matrix(), deformer:solve():hash()
        expect.near(matrix.turn, { 0, angle, 0 })
        top:set_matrix(top:matrix())
        expect.near(top:matrix().turn, { 0, angle, 0 })
        top:reset()
        deformer:solve()
        top:set_matrix(matrix)
        expect.near(top:matrix().turn, { 0, angle, 0 })
        expect.equal(deformer:solve():hash(), solved)
        matrix.turn = nil
        top:reset():set_matrix(matrix)
        expect.truthy(math.abs(top:matrix().turn[2]) <= 180 + 1e-9)
    end
    local _, _, _, top = bar()
    expect.error(function()
        local matrix = top:matrix()
        matrix.turn = 3
        top:set_matrix(matrix)
    end, "turn: {x, y, z} expected")
end)

test("every threshold of degenerate vertices works", function()
    for _, threshold in ipairs{ 1.01, 10, 100, 1000 } do
        local mesh = lissom.shapes.bar{ across = 4, along = 16 }
        local deformer = lissom.deformer(mesh, { degenerate_threshold = threshold })
        deformer:add_handle(mesh:region("bottom"))
        deformer:add_handle(mesh:region("top")):rotate{ axis = "z", angle = 60 }
        expect.truthy(deformer:solve())
    end
end)

test("a scanned mesh", function()
    local scan = assert(lissom.load(models.path("models/armadillo_43k.obj")))
    local box = scan:bounds()
    local foot = scan:region{ box = { max = { 1 / 0, box.min[2] + 0.1 * box.diagonal, 1 / 0 } } }
    local head = scan:region{ box = { min = { -1 / 0, box.max[2] - 0.1 * box.diagonal, -1 / 0 } } }
    local deformer = lissom.deformer(scan)
    deformer:add_handle(foot)
    deformer:add_handle(head):rotate{ axis = "y", angle = 45 }
    expect.truthy(deformer:solve())
    expect.truthy(scan:check().zero_area_faces)
end)

-- A strip of faces in the plane z = 0, and its two ends as regions.
local function strip()
    local points, faces = {}, {}
    for y = 0, 4 do for x = 0, 40 do table.insert(points, { x / 10, y / 10, 0 }) end end
    for y = 0, 3 do
        for x = 1, 40 do
            local a = y * 41 + x
            table.insert(faces, { a, a + 1, a + 42, a + 41 })
        end
    end
    local mesh = lissom.mesh{ positions = points, faces = faces }
    return mesh, mesh:region{ box = { max = { 0.25, nil, nil } } },
        mesh:region{ box = { min = { 3.75, nil, nil } } }
end

local function off_plane(mesh)
    local most = 0
    for i = 1, #mesh do most = math.max(most, math.abs(select(3, mesh:position(i)))) end
    return most
end

test("what is flat stays flat when it is bent within its plane", function()
    for _, refine in ipairs{ 0, 1, 2 } do
        for _, angle in ipairs{ 10, 45, 90, 180 } do
            local mesh, first, last = strip()
            local deformer = lissom.deformer(mesh, { refine = refine })
            deformer:add_handle(first)
            deformer:add_handle(last):rotate{ axis = "z", angle = angle, about = { 2, 0.2, 0 } }
            deformer:solve()
            expect.truthy(off_plane(mesh) < 1e-9)
            expect.truthy(deformer:stats().extended_vertices > 0)
        end
    end
    local mesh, first, last = strip()
    local deformer = lissom.deformer(mesh, { flat = "displaced" })
    deformer:add_handle(first)
    deformer:add_handle(last):rotate{ axis = "z", angle = 90, about = { 2, 0.2, 0 } }
    deformer:solve()
    expect.truthy(off_plane(mesh) > 1e-4)
end)

test("parts that nothing holds: an error, they stay, or they follow", function()
    local function dressed()
        local button = lissom.shapes.sphere{ radius = 0.1, segments = 4 }
        button:transform{ translate = { 0.65, 0, 0 } }
        local mesh = lissom.shapes.bar{ across = 4, along = 20 }
        local count = #mesh
        mesh:append(button)
        return mesh, count
    end
    local function bent(loose)
        local mesh, count = dressed()
        local deformer = lissom.deformer(mesh, { loose = loose })
        deformer:add_handle(mesh:region{ box = { max = { nil, -2, nil } } })
        deformer:add_handle(mesh:region{ box = { min = { nil, 2, nil } } }):rotate{ axis = "z", angle = 60 }
        local before = { mesh:position(count + 1) }
        local done, problem = lissom.try(deformer.solve, deformer)
        return done, problem, before, { mesh:position(count + 1) }
    end
    local done, problem = bent(nil)
    expect.falsy(done)
    expect.truthy(problem.message:find("loose = 'follow'", 1, true))
    local _, _, before, after = bent("stay")
    expect.equal(before[1], after[1])
    _, _, before, after = bent("follow")
    expect.truthy(math.abs(before[1] - after[1]) > 0.05)
end)

test("a large mesh is deformed on two levels: a thinned surface, and all that follows it", function()
    local function bent(options)
        local mesh = lissom.shapes.bar{ across = 12, along = 60 }
        local deformer = lissom.deformer(mesh, options)
        deformer:add_handle(mesh:region("bottom"))
        local top = deformer:add_handle(mesh:region("top"))
        top:rotate{ axis = "x", angle = 60 }
        top:translate(0, 0, -1)
        return deformer:solve(), deformer
    end
    local whole, levels = bent{}, bent{ levels = "auto", level_vertices = 700 }
    local off = 0
    for i = 1, #whole do
        local a, b = { whole:position(i) }, { levels:position(i) }
        off = math.max(off, math.sqrt((a[1] - b[1]) ^ 2 + (a[2] - b[2]) ^ 2 + (a[3] - b[3]) ^ 2))
    end
    expect.truthy(off > 1e-6 and off < 0.05 * whole:size())
    -- Too few vertices for a thinned surface of 40,000.
    expect.equal(bent{ levels = "auto" }:hash(), whole:hash())
    -- What needs the whole surface says so.
    local _, deformer = bent{ levels = "auto", level_vertices = 700 }
    expect.error(function() deformer:basis() end, "needs the whole surface")
end)

test("a report says what a result did, and handles that nearly touch tear", function()
    local mesh = lissom.shapes.bar{ across = 4, along = 20 }
    local low, high = mesh:region{ box = { max = { nil, 0.1, nil } } },
        mesh:region{ box = { min = { nil, 0.1, nil } } }
    local stretch = {}
    for _, rings in ipairs{ 0, 3 } do
        local deformer = lissom.deformer(mesh, { free_rings = rings })
        deformer:add_handle(low)
        deformer:add_handle(high):rotate{ axis = "y", angle = 90 }
        deformer:solve()
        local report = deformer:report{ crossings = true }
        stretch[rings] = report.stretch
        expect.equal(#report.warnings > 0, rings == 0)
        if rings == 0 then
            expect.equal(report.warnings[1].kind, "torn")
            expect.truthy(report.warnings[1].message:find("free_rings", 1, true))
            expect.equal(#report.warnings[1].vertices % 2, 0)
        end
        expect.equal(#report.tears > 0, rings == 0)
        expect.equal(report.crossings, 0)
        local torn = "^torn.*folded face.*volume.*\n  torn: .*free_rings"
        local ok = "^ok: edges stretch up to [%d.]+ times, no folded faces, no pairs of faces cross, volume"
        expect.truthy(tostring(report):find(rings == 0 and torn or ok))
        expect.truthy(math.abs(report.volume_change) < 0.5)
        expect.equal(deformer:report().crossings, nil)
        deformer:reset()
    end
    expect.truthy(stretch[3] < 0.6 * stretch[0])
end)

test("loose parts of a real model follow, beside quads with one diagonal, and have a basis", function()
    local mesh = assert(lissom.load(models.path("models/suzanne_quads.obj")))
    local box = mesh:bounds()
    local height = box.max[2] - box.min[2]
    for _, refine in ipairs{ 0, 2 } do
        local deformer = lissom.deformer(mesh, { loose = "follow", refine = refine })
        deformer:add_handle(mesh:region{ box = { max = { nil, box.min[2] + 0.15 * height, nil } } })
        deformer:add_handle(mesh:region{ box = { min = { nil, box.max[2] - 0.15 * height, nil } } })
            :rotate{ axis = "x", angle = 30 }
        assert(deformer:solve())
        expect.truthy(deformer:report().stretch < 2)
        expect.equal(#assert(deformer:basis()).weights, 2)
        deformer:reset()
    end
end)

test("lissom.deform deforms once and returns the mesh", function()
    local mesh = lissom.shapes.bar()
    local bent = lissom.deform(mesh, {
        second = "laplacian", pin = mesh:region("bottom"),
        handles = { { region = mesh:region("top"), rotate = { axis = "z", angle = 60 },
            translate = { 1, 0, 0 }, scale = 1.2, about = { 0, 2.5, 0 } } },
    })
    expect.truthy(rawequal(bent, mesh))
    local other = lissom.shapes.bar()
    local deformer = lissom.deformer(other, { second = "laplacian" }):pin(other:region("bottom"))
    deformer:add_handle(other:region("top")):set{ rotate = { axis = "z", angle = 60 },
        translate = { 1, 0, 0 }, scale = 1.2, about = { 0, 2.5, 0 } }
    expect.equal(deformer:solve():hash(), mesh:hash())
    -- Several regions may stay, and several move.
    local third = lissom.shapes.bar()
    lissom.deform(third, { pin = { third:region("bottom") }, handles = {
        { region = third:region("top"), rotate = { axis = "z", angle = 380 } } } })
    expect.truthy(third:hash() ~= mesh:hash())
end)

test("lissom.deform changes nothing if a handle is refused, and says which", function()
    local mesh = lissom.shapes.bar()
    local before, top = mesh:hash(), mesh:region("top")
    local function deform(handles) return function() lissom.deform(mesh, { handles = handles }) end end
    expect.error(deform(nil), "lissom.deformer(mesh, {...})")
    expect.error(deform{}, "list of")
    expect.error(deform{ { region = top, rotat = 1 } }, "handles[1]")
    expect.error(deform{ { region = top }, { scale = 2 } }, "handles[2]")
    expect.error(deform{ { region = top }, { region = top } }, "[handle_overlap]")
    expect.error(deform{ { region = top, scale = 0 } }, "[singular_transform]")
    expect.equal(mesh:hash(), before)
end)

test("a pinned region stays; handles turn by an axis and an angle or by a table", function()
    local mesh = lissom.shapes.bar()
    local bottom, top = mesh:region("bottom"), mesh:region("top")
    local v = bottom:vertices()[1]
    local before = { mesh:position(v) }
    local deformer = lissom.deformer(mesh)
    expect.truthy(rawequal(deformer:pin(bottom), deformer))
    local handle = deformer:add_handle(top)
    handle:rotate("z", 60)
    local by_position = handle:matrix()
    handle:reset():rotate{ axis = "z", angle = 60 }
    expect.near(handle:matrix()[1], by_position[1], 0)
    handle:reset():rotate({ 0, 0, 2 }, 60, { about = { 0, 0, 0 } })
    expect.near(handle:matrix()[1], { 0.5, -math.sqrt(0.75), 0, 0 }, 1e-12)
    deformer:solve()
    expect.near({ mesh:position(v) }, before, 0)
    expect.error(function() handle:rotate("z") end, "angle")
    expect.error(function() handle:rotate{ axis = "z" } end, "angle")
    expect.error(function() handle:rotate("z", 60, { axis = "z" }) end, "axis")
    expect.error(function() handle:rotate("z", { angle = 5, abuot = 1 }) end, "did you mean 'about'")
    expect.error(function() handle:rotate() end, "axis")
    expect.error(function() deformer:pin(bottom) end, "[handle_overlap]")
end)

-- A bar, its deformer, and the handle of its upper end.
local function bar_with_top()
    local body = lissom.shapes.bar{ width = 1, length = 6, across = 4, along = 24 }
    local deformer = lissom.deformer(body):pin(body:region("bottom"))
    return body, deformer, deformer:add_handle(body:region("top"))
end

-- The upper end comes down onto the lower one.
local function fold(top)
    top:set{ rotate = { axis = "z", angle = 160 }, translate = { 0.3, -5, 0 } }
end

test("contacts: pairs, their faces and their region", function()
    local body, deformer, top = bar_with_top()
    expect.equal(#deformer:contacts(), 0)
    fold(top)
    deformer:solve()
    local found = deformer:contacts()
    expect.truthy(#found > 0)
    expect.equal(#found, deformer:report{ crossings = true }.crossings)
    local is_listed = {}
    for _, face in ipairs(found.faces) do is_listed[face] = true end
    for i, pair in ipairs(found) do
        expect.truthy(pair[1] < pair[2] and is_listed[pair[1]] and is_listed[pair[2]])
        for _, face in ipairs(pair) do
            for _, v in ipairs(body:face(face)) do expect.truthy(found.region:contains(v)) end
        end
        local before = found[i - 1]
        expect.truthy(not before or before[1] <= pair[1])
    end
    deformer:reset()
    expect.equal(#deformer:contacts(), 0)
    expect.equal(#deformer:contacts().faces, 0)
    expect.equal(#deformer:contacts().region, 0)
end)

test("stop: the mesh and the handle stay at the last pose without contact", function()
    local body, deformer, top = bar_with_top()
    fold(top)
    local mesh, stop = deformer:solve{ stop = "contact" }
    expect.truthy(mesh == body)
    expect.truthy(stop.share > 0 and stop.share < 1)
    expect.truthy(#stop.contacts > 0 and #stop.contacts.faces > 1)
    expect.equal(#deformer:contacts(), 0)
    local reached = body:hash()
    deformer:solve()
    expect.equal(body:hash(), reached)
    top:set{ translate = { 0.2, 0, 0 } }
    local _, free = deformer:solve{ stop = "contact" }
    expect.equal(free.share, 1)
    expect.equal(#free.contacts, 0)
    expect.equal(select("#", deformer:solve()), 1)
end)

test("stop: an unknown reason, a draft, and a mesh of another topology", function()
    local body, deformer, top = bar_with_top()
    expect.error(function() deformer:solve{ stop = "wall" } end, "contact")
    expect.error(function() deformer:solve{ stop = "contact", draft = true } end, "draft")
    fold(top)
    local before = body:hash()
    body:triangulate()
    local after = body:hash()
    expect.truthy(before ~= after)
    expect.error(function() deformer:solve{ stop = "contact" } end, "[topology_mismatch]")
    expect.error(function() deformer:contacts() end, "[topology_mismatch]")
    expect.equal(body:hash(), after)
end)
