-- When to choose which `second`: a tube is bent and its end moved aside. blend leaves its handles smoothly
-- and distorts little; laplacian is the smoothest and distorts most; poisson distorts least and creases at
-- handles.
--
--     lissom run examples/deform/second.lua

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    turn = { type = "number", default = 80, min = 0, max = 150, unit = "degrees",
        help = "how far the upper end turns over" },
    around = { type = "integer", default = 64, min = 24, max = 200, help = "quads around the tube" },
    size = { type = "integer", default = 380, min = 80, help = "height of the picture in pixels" },
    out = { type = "folder", default = "out", help = "folder that the files go to" },
}

local tube = lissom.shapes.cylinder{
    radius = 0.5, height = 5, segments = params.around, rings = 2 * params.around,
}
figures.set_ends(tube, 2, 0.16)
local handles = {
    low = figures.hold,
    high = function(handle)
        handle:rotate{ axis = "z", angle = -params.turn }:translate(1.6, -0.6, 0)
    end,
}

-- The sharpest turn of the surface along the tube: the angle between faces at an edge, less that at rest.
local function crease(mesh)
    local at_rest, angles, worst = {}, {}, 0
    figures.each_fold(tube, function(degrees) table.insert(at_rest, degrees) end)
    figures.each_fold(mesh, function(degrees) table.insert(angles, degrees) end)
    for i, degrees in ipairs(angles) do
        worst = math.max(worst, degrees - at_rest[i])
    end
    return worst
end

local panels, found = {}, {}
figures.row("second", "%8s %8s %8s", "crease", "99 %", "worst")
for _, second in ipairs{ "blend", "laplacian", "poisson" } do
    local mesh = figures.deformed(tube, { second = second }, handles)
    local a = figures.anisotropy(tube, mesh)
    found[second] = { crease = crease(mesh), p99 = a.p99 }
    figures.row(second, "%8.1f %8.3f %8.3f", found[second].crease, a.p99, a.max)
    table.insert(panels, { mesh, string.format("%s: crease %.0f, stretch %.2f",
        second, found[second].crease, a.p99) })
end
print("crease in degrees beyond rest; stretch: ratio of greatest to least of 99 % of the triangles")

figures.write{
    name = "second", out = params.out, panels = panels, size = { 2 * params.size, params.size },
    handles = { "low", "high" }, view = "front", wire = true,
}
figures.claim(found.poisson.crease > 1.5 * found.blend.crease, "poisson creases but blend does not")
figures.claim(found.laplacian.p99 > found.blend.p99, "laplacian distorts more than blend")
