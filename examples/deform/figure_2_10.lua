-- Two handles are moved together (Figure 2.10): details that keep their size have no room between them; with
-- local_size = "scale" they shrink with the surface around them.
--
--     lissom run examples/deform/figure_2_10.lua
--     lissom run examples/deform/figure_2_10.lua --mesh lion.off --closer 0.6
--
-- A model given as `mesh` is held at the two ends of its longest side.

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    mesh = { type = "file", default = "", help = "a model instead of the generated body" },
    share = { type = "number", default = 0.2, min = 0.02, max = 0.45,
        help = "share of the length that each handle takes" },
    view = { type = "string", default = "right", help = "side to look from" },
    closer = { type = "number", default = 0.5, min = 0, max = 0.9,
        help = "how much of the space between the handles goes" },
    rings = { type = "integer", default = 120, min = 60, max = 600, help = "rings of the generated body" },
    out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
}

-- A body along z with rolls of fat: between the handles five of them go round it.
local function body()
    local mesh = lissom.shapes.cylinder{
        radius = 1, height = 1, segments = 48, rings = params.rings, cap_rings = 8,
    }
    local positions = mesh:positions()
    for v = 1, #mesh do
        local x, y, z = positions[3 * v - 2], positions[3 * v - 1], positions[3 * v]
        local t = y + 0.5
        local roll = t > 0.2 and t < 0.8 and math.sin(math.pi * (t - 0.2) / 0.6 * 5) ^ 2 or 0
        local radius = 0.5 + 0.3 * roll * (1 + 0.3 * math.cos(3 * math.atan(z, x)))
        -- Ends are round.
        local round = math.sqrt(math.max(0, 1 - (math.abs(y) / 0.5) ^ 6))
        if x * x + z * z > 0.999 then radius = radius * (0.4 + 0.6 * round) else radius = radius * 0.4 end
        positions[3 * v - 2], positions[3 * v - 1], positions[3 * v] = radius * x, radius * z, -3.5 * y
    end
    return mesh
end

local rest = params.mesh ~= "" and lissom.load(params.mesh) or body()
local axis, box = figures.longest_axis(rest), rest:bounds()
figures.set_ends(rest, axis, params.share)
rest:set_region("body", rest:region("low"):union(rest:region("high")):invert())
local way = { 0, 0, 0 }
way[axis] = 0.5 * params.closer * (1 - 2 * params.share) * (box.max[axis] - box.min[axis])
local handles = {
    low = function(handle) handle:translate(way) end,
    high = function(handle) handle:translate(-way[1], -way[2], -way[3]) end,
}

local keep = figures.deformed(rest, { local_size = "keep" }, handles)
local scale, deformer = figures.deformed(rest, { local_size = "scale" }, handles)

-- Measures the surface between the handles: its area, how far triangles are from their shape, and how many
-- edges are folded.
local function measure(mesh)
    local before, after = rest:extract(rest:region("body")), mesh:extract(mesh:region("body"))
    local shape = figures.anisotropy(before, after)
    return after:area() / before:area(), shape.p50, shape.p99, select(2, figures.roughness(after))
end
print(string.format("%d vertices, %d of them free; the handles come %.0f %% closer", #rest,
    deformer:stats().free_vertices, 100 * params.closer))
figures.row("between the handles", "%8s %8s %8s %8s", "area", "median", "99 %", "folds")
local found = {}
for i, row in ipairs{ { "local_size = keep", keep }, { "local_size = scale", scale }, { "at rest", rest } } do
    found[i] = table.pack(measure(row[2]))
    figures.row(row[1], "%8.3f %8.3f %8.3f %8d", table.unpack(found[i]))
end
print("area as a fraction, anisotropy of triangles, and edges folded by more than a right angle")

figures.write{
    name = "figure_2_10", out = params.out, columns = 3, size = { 1700, 640 }, view = params.view,
    handles = { "low", "high" },
    panels = { { rest, "at rest" }, { keep, "details keep their size" }, { scale, "details scale" } },
}
figures.claim(found[2][1] < found[1][1], "details that scale need less room")
figures.claim(found[2][3] < found[1][3], "triangles keep their shape better as details scale")
