-- When to choose bones: limbs that bend at joints, where handles would have to be painted and turned one by
-- one. A chain of bones finds its influence by itself, and `reach` brings its tip to a point.
--
--     lissom run examples/deform/bones.lua

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    bones = { type = "integer", default = 3, min = 2, max = 8, help = "bones of the arm" },
    size = { type = "integer", default = 330, min = 80, help = "height of the picture in pixels" },
    out = { type = "folder", default = "out", help = "folder that the files go to" },
}

-- An arm with rings, so that the surface between the joints is seen to turn.
local arm = lissom.shapes.cylinder{ radius = 0.4, height = 6, segments = 48, rings = 240, cap_rings = 8 }
for i = 1, #arm do
    local x, y, z = arm:position(i)
    local bulge = 1 + 0.05 * math.cos(2 * math.pi * 3 * y)
    if math.abs(y) < 2.9 then arm:set_position(i, x * bulge, y, z * bulge) end
end

local joints = {}
for i = 0, params.bones do joints[i + 1] = { 0, -2.6 + 5.2 * i / params.bones, 0 } end

-- The arm with its bones turned by a function, and the joints as they are then.
local function posed(change, limits)
    local mesh = arm:copy()
    local deformer = lissom.deformer(mesh, { refine = 1 }):pin(mesh:region("bottom"))
    local bones = deformer:add_bones{ joints = joints, limits = limits }
    change(bones)
    deformer:solve()
    return mesh, bones
end

local turned = posed(function(bones)
    for i = 2, #bones do bones:turn(i, "z", -100 / (#bones - 1)) end
end)
local target = { 2.2, 0.4, 0 }
local left
local reached = posed(function(bones) left = bones:reach(target, { axis = "z" }) end)
local limits = {}
for i = 1, params.bones do limits[i] = 40 end
local off
local limited = posed(function(bones) off = bones:reach(target, { axis = "z" }) end, limits)

figures.write{
    name = "bones", out = params.out, columns = 4, fit = "all", view = "front",
    panels = {
        { arm, "rest" }, { turned, "turned by 100 degrees" },
        { reached, string.format("reaches, %.3f left", left) },
        { limited, string.format("limits of 40 degrees, %.2f left", off) },
    },
    size = { 4 * params.size, params.size },
}
