-- When to choose `refine`: it lessens the distortion of parts that bend and twist, as that of the bar. Leave
-- it at 0 if the surface runs through itself or nearly does: refined parts get thinner and cross more, as in
-- the crook of the cactus.
--
--     lissom run examples/deform/refine.lua

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    twist = { type = "number", default = 150, min = 0, max = 720, unit = "degrees",
        help = "how far the bar's upper end turns" },
    bend = { type = "number", default = 90, min = 0, max = 170, unit = "degrees",
        help = "how far the cactus's top turns over" },
    size = { type = "integer", default = 330, min = 80, help = "height of the picture in pixels" },
    out = { type = "folder", default = "out", help = "folder that the files go to" },
}

local bar = lissom.shapes.bar{ length = 5, width = 1, across = 10, along = 50 }
figures.set_ends(bar, 2, 0.1)
local twist = {
    low = figures.hold,
    high = function(handle) handle:rotate{ axis = "y", angle = params.twist } end,
}

local cactus = lissom.shapes.cactus{ vertices = 4000 }
figures.set_ends(cactus, 2, 0.12)
local bend = {
    low = figures.hold,
    high = function(handle) handle:rotate{ axis = "z", angle = -params.bend } end,
}

-- A copy without and one with refinement.
local function pair(rest, handles, found)
    local panels = {}
    for _, refine in ipairs{ 0, 2 } do
        local mesh = figures.deformed(rest, { refine = refine }, handles)
        local a, crossing = figures.anisotropy(rest, mesh), #mesh:self_intersections()
        figures.row("refine " .. refine, "%8.3f %8.3f %8d", a.p50, a.p99, crossing)
        found[refine] = { p99 = a.p99, crossing = crossing }
        table.insert(panels, { mesh, string.format("refine %d: stretch %.2f, crossing %d",
            refine, a.p99, crossing) })
    end
    return panels
end

local twisted, bent = {}, {}
figures.row("", "%8s %8s %8s", "median", "99 %", "crossing")
local panels = pair(bar, twist, twisted)
for _, panel in ipairs(pair(cactus, bend, bent)) do table.insert(panels, panel) end
print("ratio of greatest to least stretch of triangles, and pairs of faces that run through one another")

figures.write{
    name = "refine", out = params.out, panels = panels, columns = 4, fit = "each",
    size = { 3 * params.size, params.size }, handles = { "low", "high" }, wire = true, view = "front",
}
figures.claim(twisted[2].p99 < twisted[0].p99, "refine lessens the distortion of a twisted bar")
figures.claim(bent[2].crossing >= bent[0].crossing, "refine does not help if the surface crosses itself")
