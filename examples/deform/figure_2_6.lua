-- A deformation without and with shear removal (Figure 2.6): the first system alone shears parts far from the
-- handles; the second reconstructs the shape from the rotations only.
--
--     lissom run examples/deform/figure_2_6.lua
--     lissom run examples/deform/figure_2_6.lua --mesh model.obj --turn 120 --tilt 30
--
-- A model given as `mesh` is held and moved at the two ends of its longest side.

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    mesh = { type = "file", default = "", help = "a model instead of the generated cactus" },
    turn = { type = "number", default = 100, min = -170, max = 170, unit = "degrees",
        help = "how far the upper end turns about the axis of the model" },
    tilt = { type = "number", default = 75, min = -120, max = 120, unit = "degrees",
        help = "how far it then turns over" },
    vertices = { type = "integer", default = 5000, min = 2000, max = 100000,
        help = "vertices of the cactus" },
    view = { type = "string", default = "front", help = "side to look from" },
    out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
}

local rest = params.mesh ~= "" and lissom.load(params.mesh)
    or lissom.shapes.cactus{ vertices = params.vertices }
local axis = figures.longest_axis(rest)
figures.set_ends(rest, axis, 0.1)
local along, across = { 0, 0, 0 }, { 0, 0, 0 }
along[axis], across[axis % 3 + 1] = 1, 1

-- The far end goes round a quarter of an arc whose centre lies beside the model.
local handles = {
    low = figures.hold,
    high = function(handle)
        handle:rotate{ axis = along, angle = params.turn }
        handle:rotate{ axis = across, angle = -params.tilt, about = rest:bounds().center }
    end,
}
local sheared = figures.deformed(rest, {}, handles, true)
local removed = figures.deformed(rest, {}, handles)

figures.row("anisotropy of triangles", "%8s %8s %8s %8s", "median", "99 %", "worst", "volume")
local worst = {}
for i, row in ipairs{ { "without shear removal", sheared }, { "with shear removal", removed } } do
    local a = figures.anisotropy(rest, row[2])
    worst[i] = a
    figures.row(row[1], "%8.3f %8.3f %8.3f %8.3f", a.p50, a.p99, a.max, row[2]:volume() / rest:volume())
end

figures.write{
    name = "figure_2_6", out = params.out, columns = 3, size = { 1500, 720 }, view = params.view,
    handles = { "low", "high" },
    panels = { { rest, "at rest" }, { sheared, "without shear removal" }, { removed, "with shear removal" } },
}
local less = worst[2].p50 < worst[1].p50 and worst[2].p99 < worst[1].p99
figures.claim(less, "the second system takes shear out")
