local lissom = require "lissom"

-- The upper half of a sphere, as a region.
local function half_sphere()
    local mesh = lissom.shapes.sphere()
    return mesh, mesh:region{ plane = { point = { 0, 0, 0 }, normal = { 0, 1, 0 } } }
end

-- Smallest and greatest number of each column of a buffer of width 2, without those that are none.
local function extent(uv)
    local low, high = { math.huge, math.huge }, { -math.huge, -math.huge }
    for i = 1, #uv do
        local column = (i - 1) % 2 + 1
        if uv[i] == uv[i] then
            low[column], high[column] = math.min(low[column], uv[i]), math.max(high[column], uv[i])
        end
    end
    return low, high
end

test.group("parameterize", function()
    test("returns the mesh and what the map is like", function()
        local mesh, half = half_sphere()
        for _, method in ipairs{ "lscm", "arap", "tutte" } do
            local same, report = mesh:parameterize{ region = half, method = method }
            expect.truthy(rawequal(same, mesh))
            expect.equal(report.method, method)
            expect.equal(#report.flipped, 0)
            expect.equal(#report.degenerate, 0)
            expect.equal(report.crossings, 0)
            expect.equal(report.boundaries, 1)
            expect.truthy(report.min_scale > 0 and report.min_scale < 1)
            expect.truthy(report.max_scale >= 1)
            expect.equal(#report.energy > 0, method == "arap")
            expect.equal(report.iterations > 0, method == "arap")
        end
    end)

    test("a grid keeps its shape in the unit square", function()
        local grid = lissom.shapes.grid{ size = { 4, 2 } }
        local _, report = grid:parameterize()
        expect.near({ report.min_scale, report.max_scale }, { 1, 1 }, 1e-6)
        local low, high = extent(grid:attribute("uv"))
        local size = { high[1] - low[1], high[2] - low[2] }
        expect.near(math.max(size[1], size[2]), 1, 1e-9)
        expect.truthy(low[1] >= 0 and low[2] >= 0 and high[1] <= 1 and high[2] <= 1)
        grid:parameterize{ placement = "as_is", attribute = "uv2" }
        local uv = grid:attribute("uv2")
        local u, v = uv:get(1)
        local next_u, next_v = uv:get(2)
        local face = grid:face(1)
        local x, y, z = grid:position(face[1])
        local next_x, next_y, next_z = grid:position(face[2])
        expect.near(math.sqrt((next_u - u) ^ 2 + (next_v - v) ^ 2),
            math.sqrt((next_x - x) ^ 2 + (next_y - y) ^ 2 + (next_z - z) ^ 2), 1e-6)
    end)

    test("corners of other faces keep their coordinates, or have none", function()
        local mesh, half = half_sphere()
        mesh:parameterize{ region = half }
        local uv = mesh:attribute("uv")
        local none = 0
        for i = 1, uv:count() do
            local u = uv:get(i)
            if u ~= u then none = none + 1 end
        end
        expect.truthy(none > 0.4 * uv:count() and none < 0.7 * uv:count())
        mesh:parameterize{ region = mesh:region{ plane = { point = { 0, 0, 0 }, normal = { 0, -1, 0 } } } }
        uv = mesh:attribute("uv")
        for i = 1, #uv do expect.truthy(uv[i] == uv[i]) end
    end)

    test("coordinates of vertices become those of corners", function()
        local grid = lissom.shapes.grid()
        grid:add_attribute{ name = "uv", width = 2, values = { 7, 8 } }
        local left = grid:region{ box = { min = { -1, -1, -1 }, max = { 0, 1, 1 } } }
        grid:parameterize{ region = left }
        expect.equal(grid:attributes()[1].domain, "corner")
        local _, high = extent(grid:attribute("uv"))
        expect.near(high, { 7, 8 })
    end)

    test("they are saved and loaded", function()
        local mesh = half_sphere()
        local half = mesh:extract(mesh:region{ plane = { point = { 0, 0, 0 }, normal = { 0, 1, 0 } } })
        half:parameterize()
        local path = test.file("half.obj")
        assert(half:save(path))
        local loaded = assert(lissom.load(path))
        expect.near(loaded:attribute("uv"):table(), half:attribute("uv"):table(), 1e-6)
    end)

    test("what cannot be laid out is refused, and the mesh stays as it was", function()
        local mesh = lissom.shapes.sphere()
        local hash = mesh:hash()
        expect.truthy(expect.failure("not_a_disk", mesh.parameterize, mesh).elements)
        local one, other = mesh:region{ vertices = { 1 } }, lissom.shapes.sphere():region{ all = true }
        expect.error(function() mesh:parameterize{ region = one } end, "region_empty")
        expect.error(function() mesh:parameterize{ region = other } end, "topology_mismatch")
        local grid = lissom.shapes.grid()
        grid:add_attribute{ name = "heat" }
        expect.error(function() grid:parameterize{ attribute = "heat" } end, "invalid_argument")
        expect.error(function() grid:parameterize{ method = "flat" } end, "lscm")
        expect.equal(mesh:hash(), hash)
        expect.equal(#mesh:attributes(), 0)
    end)
end)

test.group("fill", function()
    test("with the least area a lid, without new vertices where it is not refined", function()
        local tube = lissom.shapes.cylinder{ caps = false }
        local vertices = #tube
        for _ = 1, 2 do
            local _, report = tube:fill(tube:boundaries()[1], { method = "area", subdivide = false })
            expect.equal(report.vertex_count, 0)
            expect.equal(report.face_count, report.loop_size - 2)
        end
        expect.truthy(tube:is_closed())
        expect.equal(#tube, vertices)
        expect.near(tube:volume(), lissom.shapes.cylinder():volume(), 1e-9)
    end)

    test("a denser patch has more vertices and bends more evenly", function()
        local plain, dense = lissom.shapes.cylinder{ caps = false }, lissom.shapes.cylinder{ caps = false }
        local _, few = plain:fill(plain:boundaries()[1])
        local _, many = dense:fill(dense:boundaries()[1], { density = 3 })
        expect.truthy(many.vertex_count > 4 * few.vertex_count)
        expect.error(function() dense:fill(dense:boundaries()[1], { density = 0 }) end, "density")
    end)

    test("is never greater than with the least angle", function()
        local areas = {}
        for _, method in ipairs{ "area", "angle" } do
            local mesh = half_sphere()
            local upper = mesh:region{ plane = { point = { 0, -0.2, 0 }, normal = { 0.3, 1, 0 } } }
            local bowl = mesh:extract(upper)
            for i = 1, #bowl do
                local x, y, z = bowl:position(i)
                bowl:set_position(i, x, y + 0.4 * x * x - 0.4 * z * z, z)
            end
            bowl:fill(bowl:boundaries()[1], { method = method, subdivide = false, fair = false })
            areas[method] = bowl:area()
        end
        expect.truthy(areas.area <= areas.angle + 1e-9)
    end)
end)
