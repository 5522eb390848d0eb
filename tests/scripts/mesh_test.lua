local lissom = require "lissom"
local box = lissom.shapes.box{ size = { 1, 2, 3 } }
local cactus = lissom.shapes.cactus{ vertices = 2000 }
local arm = cactus:region("left_arm")
local any = lissom.shapes.box{ size = 2 }

test("counts and measures of a known shape", function()
    expect.equal(#box, 8)
    expect.equal(box:vertex_count(), 8)
    expect.equal(box:face_count(), 6)
    expect.near(box:area(), 22)
    expect.near(box:volume(), 6)
    expect.near(box:bounds().min, { -0.5, -1, -1.5 })
    expect.near(box:bounds().diagonal, math.sqrt(14))
    expect.equal(box:components(), 1)
    expect.equal(box:genus(), 0)
    expect.truthy(box:is_closed() and box:is_manifold())
    expect.truthy(tostring(box):find("8 vertices, 6 faces", 1, true))
end)

test("size() does not change when the mesh turns", function()
    local size = box:size()
    box:transform{ rotate = { axis = { 1, 2, 3 }, angle = 40, about = { 5, 5, 5 } } }
    expect.near(box:size(), size, 1e-12)
end)

test("degrees, counter-clockwise; scale before rotation before translation", function()
    local triangle = lissom.mesh{
        positions = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
        faces = { { 1, 2, 3 } },
    }
    triangle:transform{ rotate = { axis = "z", angle = 90 }, scale = 2, translate = { 0, 0, 5 } }
    expect.near({ triangle:position(1) }, { 0, 2, 5 })
    triangle:transform{ scale = { 1, 1, 0.5 }, about = { 0, 0, 5 } }
    expect.near({ triangle:position(3) }, { 0, 0, 6 })
end)

test("elements", function()
    local grid = lissom.shapes.grid()
    expect.equal(#grid:face(1), 4)
    expect.equal(#grid:faces(), 100)
    expect.equal(#grid:neighbors(1), 2)
    expect.near({ grid:normal(1) }, { 0, 1, 0 })
    expect.error(function() grid:face(101) end, "face 101 is not one of the 100 of the mesh")
    grid:set_position(1, 1, 2, 3)
    expect.near({ grid:position(1) }, { 1, 2, 3 })
    grid:set_position(1, { 4, 5, 6 })
    expect.near({ grid:position(1) }, { 4, 5, 6 })
end)

test("in place and chained, or a new mesh", function()
    local two = lissom.shapes.box()
    expect.equal(two:append(two):components(), 2)
    expect.equal(two:triangulate():face_count(), 24)
    local before = two:volume()
    expect.near(two:flip():volume(), -before)
    local copy = two:copy()
    expect.truthy(copy == two and not rawequal(copy, two))
    copy:set_position(1, 9, 9, 9)
    expect.truthy(copy ~= two)
    expect.equal(lissom.shapes.box():subdivide(2):face_count(), 96)
    expect.equal(#lissom.shapes.box():subdivide(0), 8)
end)

test("a mirror keeps the surface looking outward", function()
    expect.near(lissom.shapes.box():transform{ scale = { -1, 1, 1 } }:volume(), 1)
end)

test("smoothing a region leaves the rest alone", function()
    local still = cactus:region("base"):vertices()[1]
    local x, y, z = cactus:position(still)
    local hash = cactus:hash()
    cactus:smooth{ iterations = 3, region = arm, keep_volume = true, weights = "cotangent" }
    expect.truthy(cactus:hash() ~= hash)
    expect.near({ cactus:position(still) }, { x, y, z }, 0)
end)

test("parts and what they were", function()
    local part, map = cactus:extract(arm)
    expect.equal(#map, #part)
    expect.near({ part:position(1) }, { cactus:position(map[1]) }, 0)
    local rest = cactus:remove(arm)
    expect.equal(part:face_count() + rest:face_count(), cactus:face_count())
end)

test("nearest point and ray", function()
    local ball = lissom.shapes.sphere{ segments = 32 }
    local found = ball:nearest(2, 0, 0)
    expect.near(found.distance, 1, 1e-2)
    expect.near(found.bary[1] + found.bary[2] + found.bary[3], 1)
    expect.equal(ball:pick({ 0, 5, 0 }, { 0, 1, 0 }), nil)
    local hit = ball:pick({ 0, 5, 0 }, { 0, -1, 0 })
    expect.near(hit.distance, 4, 1e-2)
    expect.near({ ball:position(hit.vertex) }, hit.position, 0.2)
    -- ... of the present shape.
    ball:transform{ translate = { 0, 10, 0 } }
    expect.near(ball:nearest(0, 0, 0).distance, 9, 1e-2)
    local positions = ball:positions()
    for i = 2, #positions, 3 do positions[i] = positions[i] - 10 end
    expect.near(ball:nearest(0, 3, 0).distance, 2, 1e-2)
end)

test("distances", function()
    local plane = lissom.shapes.grid{ size = 1, segments = 20 }
    local corner = plane:nearest(-0.5, 0, -0.5).vertex
    local opposite = plane:nearest(0.5, 0, 0.5).vertex
    expect.near(plane:distances{ from = corner, method = "edges" }[opposite], 2)
    expect.near(plane:distances{ from = { corner } }[opposite], math.sqrt(2), 0.05)
    expect.equal(plane:distances{ from = plane:region("border") }[corner], 0)
    expect.equal(lissom.shapes.box():append(lissom.shapes.box()):distances{ from = 1 }[9], 1 / 0)
end)

test("names of groups and materials", function()
    local path = os.tmpname() .. ".obj"
    local file = assert(io.open(path, "w"))
    file:write("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng left\nusemtl red\nf 1 2 3\ng right\nf 1 3 4\n")
    file:close()
    local square = assert(lissom.load(path))
    expect.equal(table.concat(square:groups(), " "), "left right")
    expect.equal(table.concat(square:materials(), " "), "red")
    expect.equal(#square:region{ group = square:groups()[2] }, 3)
    expect.equal(#lissom.shapes.grid():groups(), 0)
    os.remove(path)
end)

test("how far a shape is from another", function()
    local plain = lissom.shapes.grid{ size = 1, segments = 4 }
    local shape = plain:copy():transform{ scale = { 2, 1, 1 } }
    local change = shape:distortion(plain)
    expect.equal(#change.stretch, #plain)
    for i = 1, #plain do
        expect.near(change.stretch[i], 2)
        expect.near(change.area[i], 2)
        expect.near(change.angle[i], 0)
        expect.equal(change.flips[i], 0)
    end
    shape:set_position(13, 1.3, 0, 0)
    change = shape:distortion(plain)
    expect.equal(#change.flipped, change.flips[13])
    expect.truthy(#change.flipped > 0)
    expect.error(function() shape:distortion(lissom.shapes.box()) end, "[topology_mismatch]")
end)

test("a check names what is odd", function()
    local odd = lissom.mesh{
        positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 5, 5, 5 } },
        faces = { { 1, 2, 3 } },
    }
    local report = odd:check()
    expect.near(report.isolated_vertices, { 4 })
    expect.near(report.zero_area_faces, { 1 })
    expect.equal(report.manifold, false)
    expect.equal(report.components, 2)
end)

test("data that is no manifold: the elements count from 1", function()
    local flat = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 1, 1 } }
    expect.failure("face_index", lissom.mesh, { positions = flat, faces = { { 1, 2, 6 } } })
    local problem = expect.failure("nonmanifold_edge", lissom.mesh,
        { positions = flat, faces = { { 1, 2, 3 }, { 2, 1, 4 }, { 1, 2, 5 } } })
    local elements = problem.elements
    expect.equal(elements.kind, "edge")
    expect.equal(elements.count, 1)
    expect.near(elements.ids[1], { 1, 2 })
    expect.truthy(problem.message:find("1-2", 1, true))
end)

test("what is no method but an option says of which", function()
    expect.error(function()
        any:rotate{ axis = "x", angle = 3 }
    end, "no method 'rotate'; write mesh:transform{ rotate = ... }")
    expect.error(function() any:regionss() end, "did you mean 'regions'?")
end)

test("bounds print as numbers, and are a plain table otherwise", function()
    local extent = any:bounds()
    expect.equal(tostring(extent),
        "{min = {-1, -1, -1}, max = {1, 1, 1}, center = {0, 0, 0}, diagonal = 3.4641}")
    local keys = {}
    for key in pairs(extent) do keys[#keys + 1] = key end
    table.sort(keys)
    expect.equal(table.concat(keys, " "), "center diagonal max min")
end)

test("queries see the present shape, whatever changed it", function()
    local asked = lissom.shapes.torus()
    local function same_answers()
        local fresh = asked:copy()
        for i = 1, 20 do
            local from = { 3 * math.sin(i), 2 * math.cos(3 * i), 3 * math.cos(i) }
            local a, b = asked:nearest(from), fresh:nearest(from)
            expect.equal(a.face, b.face)
            expect.equal(a.distance, b.distance)
            local towards = { -from[1], 0.3 - from[2], -from[3] }
            a, b = asked:pick(from, towards), fresh:pick(from, towards)
            expect.equal(a and a.face, b and b.face)
            expect.equal(a and a.distance, b and b.distance)
        end
    end
    same_answers()
    asked:set_position(1, 2, 0, 0)
    same_answers()
    asked:transform{ rotate = { axis = { 1, 2, 3 }, angle = 50 }, scale = { 1, 2, 0.5 } }
    same_answers()
    local buffer = asked:positions()
    for i = 1, #buffer do buffer[i] = buffer[i] + 0.1 * math.sin(97 * i) end
    buffer:changed()
    same_answers()
    asked:triangulate()
    same_answers()
    asked:smooth{ iterations = 2 }
    same_answers()
end)

test("a region alone is subdivided, and the mesh stays watertight", function()
    local cube = lissom.shapes.box()
    local top = cube:region{ plane = { point = { 0, 0.3, 0 }, normal = { 0, 1, 0 } } }
    local fine = cube:subdivide(2, { region = top })
    expect.equal(fine:face_count(), 16 + 5)
    expect.equal(fine:is_closed(), true)
    expect.near(fine:volume(), 1, 1e-12)
    expect.equal(cube:subdivide{ region = top, scheme = "loop" }:is_closed(), true)
    local corner = cube:region{ vertices = { 1 } }
    expect.error(function() assert(cube:subdivide{ region = corner }) end, "no face")
end)

test("bridge: two boundaries become one part, and what cannot be joined is refused", function()
    local tube = lissom.shapes.cylinder{ caps = false }
    local pair = tube:copy():append(tube:copy():transform{ translate = { 0, 5, 0 } })
    local rims, faces = pair:boundaries(), pair:face_count()
    local hash = pair:hash()
    expect.failure("boundary_conflict", pair.bridge, pair, rims[1], rims[1])
    expect.error(function() pair:bridge(rims[1], tube:boundaries()[1]) end, "[topology_mismatch]")
    local over = tube:copy():append(tube:copy():flip():transform{ translate = { 0, 5, 0 } })
    local wrong = over:boundaries()
    expect.failure("inconsistent_orientation", over.bridge, over, wrong[2], wrong[3])
    expect.equal(pair:hash(), hash)
    local same, first, count = pair:bridge(rims[2], rims[3])
    expect.truthy(rawequal(same, pair))
    expect.equal(first, faces + 1)
    expect.equal(count, 64)
    expect.equal(pair:components(), 1)
    local ends = pair:boundaries()
    expect.equal(#ends, 2)
    pair:bridge(ends[1], ends[2])
    expect.truthy(pair:is_closed())
    expect.equal(pair:genus(), 1)
end)

-- Other triangles for the same surface.
do
    local plant = lissom.shapes.cactus{ vertices = 2000 }

    test("decimation keeps regions and returns its error", function()
        local coarse, err = plant:decimate{ faces = 800 }
        expect.truthy(coarse:face_count() <= 800 and coarse:face_count() > 700)
        expect.truthy(err > 0 and err < 0.1 * plant:size())
        expect.near(coarse:volume(), plant:volume(), 0.05 * plant:volume())
        expect.truthy(#coarse:region("left_arm") > 3)
        local same = plant:decimate{ error = 0 }
        expect.near(same:volume(), plant:volume(), 1e-9 * plant:volume())
    end)

    test("decimation without a limit says so", function()
        local _, e = lissom.try(function() return plant:decimate{} end)
        expect.equal(e.code, "invalid_argument")
    end)

    test("lengths and counts beyond the mesh are refused in words that help", function()
        local cube, grid = lissom.shapes.box(), lissom.shapes.grid()
        local before = cube:hash()
        expect.error(function() cube:decimate{ faces = 0 } end, "faces")
        expect.error(function() cube:remesh{ edge = 100 } end, "longer than the mesh")
        expect.error(function() cube:remesh{ edge = 1e-5 } end, "use a greater length")
        expect.error(function() grid:thicken{ thickness = 1e9 } end, "units of the mesh")
        expect.error(function() cube:offset{ distance = -3 } end, "the other side")
        local beside = { point = { -9, 0, 0 }, normal = { 1, 0, 0 } }
        expect.error(function() cube:symmetrize{ plane = beside } end, "beside the mesh")
        expect.equal(cube:hash(), before)
    end)

    test("remeshing makes even edges", function()
        local even = plant:remesh{ edge = 0.1 * plant:size() }
        expect.equal(even:components(), plant:components())
        expect.near(even:area(), plant:area(), 0.05 * plant:area())
    end)

    test("a mirrored half, its partners, and a shell", function()
        local plane = { point = { 0, 0, 0 }, normal = { 1, 0, 0 } }
        local even, mirror = plant:symmetrize{ plane = plane }
        expect.equal(#mirror, #even)
        local x, y, z = even:position(1)
        local a, b, c = even:position(mirror[1])
        expect.near({ a, b, c }, { -x, y, z }, 1e-12)
        local shell, crossings = lissom.shapes.grid():thicken{ thickness = 0.02 }
        expect.truthy(shell:is_closed() and #crossings == 0)
        expect.near(shell:volume(), 0.02, 1e-9)
        local grown = lissom.shapes.box():offset{ distance = 0.5 }
        expect.near(grown:volume(), 8, 0.1)
    end)

    test("a copy is put back with its scale", function()
        local moved = plant:copy():transform{ rotate = { axis = "y", angle = 20 }, scale = 1.1 }
        local same, report = moved:align{ to = plant, scale = true }
        expect.truthy(same == moved)
        expect.near(report.scale, 1 / 1.1, 1e-4)
        expect.truthy(report.residual < 1e-3 * plant:size() and report.converged)
    end)
end
