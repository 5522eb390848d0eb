local lissom = require "lissom"

local cactus = lissom.shapes.cactus{ vertices = 2000 }

test("decimation keeps regions and returns its error", function()
    local coarse, err = cactus:decimate{ faces = 800 }
    expect.truthy(coarse:face_count() <= 800 and coarse:face_count() > 700)
    expect.truthy(err > 0 and err < 0.1 * cactus:size())
    expect.near(coarse:volume(), cactus:volume(), 0.05 * cactus:volume())
    expect.truthy(#coarse:region("left_arm") > 3)
    local same = cactus:decimate{ error = 0 }
    expect.near(same:volume(), cactus:volume(), 1e-9 * cactus:volume())
end)

test("decimation without a limit says so", function()
    local _, e = lissom.try(function() return cactus:decimate{} end)
    expect.equal(e.code, "invalid_argument")
end)

test("remeshing makes even edges", function()
    local even = cactus:remesh{ edge = 0.1 * cactus:size() }
    expect.equal(even:components(), cactus:components())
    expect.near(even:area(), cactus:area(), 0.05 * cactus:area())
end)

test("a mirrored half, its partners, and a shell", function()
    local plane = { point = { 0, 0, 0 }, normal = { 1, 0, 0 } }
    local even, mirror = cactus:symmetrize{ plane = plane }
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
    local moved = cactus:copy():transform{ rotate = { axis = "y", angle = 20 }, scale = 1.1 }
    local same, report = moved:align{ to = cactus, scale = true }
    expect.truthy(same == moved)
    expect.near(report.scale, 1 / 1.1, 1e-4)
    expect.truthy(report.residual < 1e-3 * cactus:size() and report.converged)
end)
