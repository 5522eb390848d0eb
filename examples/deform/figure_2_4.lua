-- A plane, all of whose vertices are degenerate (Figure 2.4): they are displaced to give them a deformation
-- gradient, the displacement is taken back afterwards, and cotangent weights leave less of a trace of it than
-- uniform ones. The second system spreads the rest of it.
--
--     lissom run examples/deform/figure_2_4.lua
--     lissom run examples/deform/figure_2_4.lua --segments 40 --lift 0.5

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    segments = { type = "integer", default = 22, min = 8, max = 100, help = "squares along each side" },
    irregular = { type = "number", default = 0.35, min = 0, max = 0.4,
        help = "how far vertices stray, in lengths of a square" },
    lift = { type = "number", default = 0.35, min = 0, max = 1, help = "how far the middle rises" },
    tilt = { type = "number", default = 35, min = -80, max = 80, unit = "degrees",
        help = "how far the middle tilts" },
    out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
}

-- An irregular plane: vertices inside stray, by numbers that are the same in every run.
local seed = 1
local function stray()
    seed = (seed * 16807) % 2147483647
    return (2 * seed / 2147483647 - 1) * params.irregular / params.segments
end
local plane = lissom.shapes.grid{ segments = params.segments }
for v = 1, #plane do
    local x, y, z = plane:position(v)
    if math.max(math.abs(x), math.abs(z)) < 0.499 then plane:set_position(v, x + stray(), y, z + stray()) end
end
plane:triangulate()

local function within(radius)
    return function(_, x, _, z) return x * x + z * z <= radius * radius end
end
plane:set_region("rim", plane:region{ where = function(_, x, _, z)
    return math.max(math.abs(x), math.abs(z)) > 0.499
end }:grow())
plane:set_region("middle", plane:region{ where = within(0.13) })
local free = plane:region("rim"):union(plane:region("middle")):invert()

-- Displaces each vertex that lies in one plane with its neighbours as they are by then (Eq 2.9).
local function displaced(mesh)
    local result = mesh:copy()
    local positions = result:positions()
    for _, v in ipairs(free:vertices()) do
        local flat, sum, ring = positions[3 * v - 1] == 0, 0, result:neighbors(v)
        for _, n in ipairs(ring) do
            flat = flat and positions[3 * n - 1] == 0
            sum = sum + math.sqrt((positions[3 * n - 2] - positions[3 * v - 2]) ^ 2
                + (positions[3 * n] - positions[3 * v]) ^ 2)
        end
        if flat then positions[3 * v - 1] = 0.2 * sum / #ring end
    end
    return result
end

local handles = {
    rim = figures.hold,
    middle = function(handle)
        handle:rotate{ axis = "x", angle = params.tilt }:translate(0, params.lift, 0)
    end,
}

-- Deforming the displaced plane as if it were the rest shape leaves the displacement in.
local bumpy = displaced(plane)
local kept = figures.deformed(bumpy, { flat = "displaced" }, handles, true)
local uniform, deformer = figures.deformed(plane, { flat = "displaced", weights = "uniform" }, handles, true)
local cotangent = figures.deformed(plane, { flat = "displaced" }, handles, true)
-- Laplacian coordinates in the least squares sense (Eq 2.10).
local second = figures.deformed(plane, { flat = "displaced", second = "laplacian" }, handles)
local second_uniform = figures.deformed(plane,
    { flat = "displaced", second = "laplacian", weights = "uniform" }, handles)
print(string.format("%d vertices, %d of %d free ones displaced", #plane, deformer:stats().displaced_vertices,
    deformer:stats().free_vertices))

local panels = {
    { plane, "(a) plane, rim and middle held" },
    { bumpy, "(b) degenerate vertices displaced" },
    { kept, "(c) first system, displacement kept" },
    { uniform, "(d) taken back, uniform weights" },
    { cotangent, "(e) taken back, cotangent weights" },
    { second, "(f) after the second system" },
}
local rough = {}
for i, panel in ipairs(panels) do
    rough[i] = figures.roughness(panel[1])
    print(string.format("%-40s %6.3f degrees between faces, mean", panel[2], rough[i]))
end
local uniform_rough = figures.roughness(second_uniform)
print(string.format("%-40s %6.3f degrees between faces, mean", "(f) with uniform weights", uniform_rough))
local drift, uniform_drift = select(2, figures.difference(second, cotangent)),
    select(2, figures.difference(second_uniform, uniform))
print(string.format("the second system moves vertices by %.4f of the size, rms; with uniform weights %.4f",
    drift, uniform_drift))

figures.write{
    name = "figure_2_4", out = params.out, panels = panels, columns = 3, size = { 1500, 860 },
    handles = { "rim", "middle" }, shading = "flat", margin = 0.02,
}
figures.claim(rough[5] < 0.6 * rough[3], "taking the displacement back smooths the surface")
figures.claim(rough[5] < 0.8 * rough[4], "cotangent weights are better than uniform ones")
figures.claim(rough[6] < rough[5], "the second system spreads the rest")
