-- Surfaces of high genus deform like any other (Figure 2.11): a lattice with dozens of holes is bent and
-- twisted.
--
--     lissom run examples/deform/figure_2_11.lua
--     lissom run examples/deform/figure_2_11.lua --mesh pegasus.obj --turn 60 --tilt 20
--
-- A model given as `mesh` is held and moved at the two ends of its longest side.

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    mesh = { type = "file", default = "", help = "a model instead of the generated lattice" },
    turn = { type = "number", default = 70, min = -170, max = 170, unit = "degrees",
        help = "how far the far end turns about the longest side" },
    tilt = { type = "number", default = 60, min = -120, max = 120, unit = "degrees",
        help = "how far it then turns over" },
    share = { type = "number", default = 0.1, min = 0.02, max = 0.45,
        help = "share of the length that each handle takes" },
    view = { type = "string", default = "three-quarter", help = "side to look from" },
    out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
}

-- The surface of a set of unit cubes, its corners shared.
local function cubes(filled, nx, ny, nz)
    local positions, faces, corner = {}, {}, {}
    local function vertex(x, y, z)
        local key = (x * (ny + 2) + y) * (nz + 2) + z
        if not corner[key] then
            table.insert(positions, { x, y, z })
            corner[key] = #positions
        end
        return corner[key]
    end
    -- For each side of a cube the step to the cube beyond it, and its corners seen from outside.
    local sides = {
        { { 1, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 1, 1, 1 }, { 1, 0, 1 } },
        { { -1, 0, 0 }, { 0, 0, 0 }, { 0, 0, 1 }, { 0, 1, 1 }, { 0, 1, 0 } },
        { { 0, 1, 0 }, { 0, 1, 0 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 1, 0 } },
        { { 0, -1, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 1 }, { 0, 0, 1 } },
        { { 0, 0, 1 }, { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } },
        { { 0, 0, -1 }, { 0, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 1, 0, 0 } },
    }
    for x = 0, nx - 1 do
        for y = 0, ny - 1 do
            for z = 0, nz - 1 do
                for _, side in ipairs(sides) do
                    local step = side[1]
                    if filled(x, y, z) and not filled(x + step[1], y + step[2], z + step[3]) then
                        local face = {}
                        for k = 2, 5 do
                            face[k - 1] = vertex(x + side[k][1], y + side[k][2], z + side[k][3])
                        end
                        table.insert(faces, face)
                    end
                end
            end
        end
    end
    return lissom.mesh{ positions = positions, faces = faces }
end

-- Bars along the edges of 2 x 4 x 2 cells, rounded by subdivision.
local function lattice()
    local nx, ny, nz, cell = 7, 13, 7, 3
    local function filled(x, y, z)
        if x < 0 or y < 0 or z < 0 or x >= nx or y >= ny or z >= nz then return false end
        local on = (x % cell == 0 and 1 or 0) + (y % cell == 0 and 1 or 0) + (z % cell == 0 and 1 or 0)
        return on >= 2
    end
    local rough = cubes(filled, nx, ny, nz)
    return rough:subdivide(2, { scheme = "catmull_clark" }) or rough
end

local rest = params.mesh ~= "" and lissom.load(params.mesh) or lattice()
local axis = figures.longest_axis(rest)
figures.set_ends(rest, axis, params.share)
local along, across = { 0, 0, 0 }, { 0, 0, 0 }
along[axis], across[axis % 3 + 1] = 1, 1
local handles = {
    low = figures.hold,
    high = function(handle)
        handle:rotate{ axis = along, angle = params.turn }
        handle:rotate{ axis = across, angle = -params.tilt, about = rest:bounds().center }
    end,
}

local bent, deformer = figures.deformed(rest, {}, handles)
local naive = figures.deformed(rest, { method = "naive" }, handles)
local genus = rest:genus()
print(string.format("%d vertices, %d of them free, genus %d", #rest, deformer:stats().free_vertices, genus))
figures.row("method", "%8s %8s %8s %8s", "median", "99 %", "worst", "volume")
local found, volume = {}, {}
for i, row in ipairs{ { "implicit", bent }, { "naive", naive } } do
    local a = figures.anisotropy(rest, row[2])
    found[i], volume[i] = a, row[2]:volume() / rest:volume()
    figures.row(row[1], "%8.3f %8.3f %8.3f %8.3f", a.p50, a.p99, a.max, volume[i])
end
print("anisotropy of triangles (1: kept its shape), and volume as a fraction of that at rest")

figures.write{
    name = "figure_2_11", out = params.out, columns = 3, size = { 1500, 720 }, view = params.view,
    handles = { "low", "high" },
    panels = { { rest, "genus " .. genus .. ", at rest" }, { bent, "implicit" }, { naive, "naive" } },
}
figures.claim(found[1].p99 < 0.9 * found[2].p99, "implicit distorts less than naive")
figures.claim(volume[1] > 0.75, "volume is kept")
