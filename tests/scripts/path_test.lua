local lissom = require "lissom"

local function open_tube()
    local tube = lissom.shapes.cylinder{ radius = 1, height = 2, segments = 64, caps = false }
    return tube, tube:boundaries()
end

test("boundaries", function()
    local tube, ends = open_tube()
    expect.equal(#ends, 2)
    expect.equal(#ends[1], 64)
    expect.near(ends[1]:length(), 2 * math.pi, 0.01)
    expect.truthy(ends[1]:is_closed() and ends[1]:is_boundary())
    expect.equal(#ends[1]:vertices(), 64)
    expect.equal(#ends[1]:points(), 64)
    expect.equal(#ends[1]:region(), 64)
    expect.truthy(rawequal(ends[1]:mesh(), tube))
    local near = ends[1]:nearest(5, ends[1]:points()[1][2], 0)
    expect.near(near.distance, 4, 1e-2)
    expect.truthy(near.parameter >= 0 and near.parameter <= 1)
    expect.equal(ends[1]:reversed():vertices()[1], ends[1]:vertices()[1])
end)

test("smoothing moves the mesh", function()
    local tube, ends = open_tube()
    local hash = tube:hash()
    expect.truthy(rawequal(ends[1]:smooth{ iterations = 2 }, ends[1]))
    expect.truthy(tube:hash() ~= hash)
end)

test("filling ends the paths of before", function()
    local tube, ends = open_tube()
    local mesh, report = tube:fill(ends[1])
    expect.truthy(rawequal(mesh, tube))
    expect.equal(report.loop_size, 64)
    expect.truthy(report.face_count > 0)
    expect.equal(#tube:boundaries(), 1)
    expect.error(function() ends[2]:length() end, "[topology_mismatch]")
    expect.equal(tostring(ends[2]), "lissom.Path (of an older topology)")
    tube:fill(tube:boundaries()[1], { fair = false, subdivide = false })
    expect.truthy(tube:is_closed())
    expect.error(function() tube:fill(ends[2]) end, "older version")
end)

test("paths through vertices and points", function()
    local grid = lissom.shapes.grid{ size = 1, segments = 10 }
    local path = grid:path{ points = { { -0.5, 0, -0.5 }, { 0.5, 0, -0.5 } } }
    expect.near(path:length(), 1)
    expect.truthy(not path:is_closed())
    local v = path:vertices()
    local loop = grid:path{ points = { v[1], v[#v], v[3] }, closed = true }
    expect.truthy(loop:is_closed() and not loop:is_boundary())
    expect.error(function() grid:path{ points = { 1, 5000 } } end, "[out_of_range]")
    expect.error(function() grid:path{ points = 5 } end, "list of {x, y, z} or list of ids expected")
    expect.error(function() grid:path{ points = { 1 } } end, "[invalid_argument]")
    expect.error(function() grid:fill(path) end, "[invalid_argument]")
end)
