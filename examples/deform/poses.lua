-- When to choose `pose_space`: shapes of one mesh that were posed, by deformers or by hand, and are to be
-- blended. A linear blend shortens what turns; a pose space turns it, together with its details. `transfer`
-- gives a pose to another mesh.
--
--     lissom run examples/deform/poses.lua

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    angle = { type = "number", default = 120, min = 0, max = 180, unit = "degrees",
        help = "how far the tip turns in the pose" },
    size = { type = "integer", default = 330, min = 80, help = "height of the picture in pixels" },
    out = { type = "folder", default = "out", help = "folder that the files go to" },
}

-- An arm with rings, which a pose bends and another swells.
local arm = lissom.shapes.cylinder{ radius = 0.5, height = 5, segments = 48, rings = 200, cap_rings = 8 }
for i = 1, #arm do
    local x, y, z = arm:position(i)
    local bulge = 1 + 0.06 * math.cos(2 * math.pi * 3 * y)
    if math.abs(y) < 2.4 then arm:set_position(i, x * bulge, y, z * bulge) end
end

local function posed(transform)
    local mesh = arm:copy()
    transform.region = arm:region("top")
    return lissom.deform(mesh, { pin = arm:region("bottom"), handles = { transform } })
end
local angle = math.rad(params.angle)
local bent = posed{ rotate = { axis = "z", angle = params.angle },
    translate = { -5 * (1 - math.cos(angle)) / angle, 5 * (math.sin(angle) / angle - 1), 0 } }
local thick = arm:copy()
for i = 1, #thick do
    local x, y, z = thick:position(i)
    local factor = 1 + 0.7 * math.exp(-(y / 0.8) ^ 2)
    thick:set_position(i, x * factor, y, z * factor)
end

local space = lissom.pose_space{ rest = arm, poses = { bent = bent, thick = thick } }
local half = space:blend{ bent = 0.5 }

local linear = arm:copy()
local positions, goal = linear:positions(), bent:positions()
for i = 1, #positions do positions[i] = (positions[i] + goal[i]) / 2 end

-- Another mesh takes a pose, and an engine takes all of them as morph targets.
local bar = lissom.shapes.bar{ width = 0.8, along = 60 }
local bar_bent = lissom.transfer{ from = arm, from_posed = bent, to = bar, regions = { "top", "bottom" } }
local _, report = space:targets{ correctives = { { bent = 0.5 }, { bent = 1, thick = 1 } } }

figures.write{
    name = "poses", out = params.out, columns = 8, fit = "all", view = "front",
    panels = {
        { arm, "rest" }, { bent, "pose \"bent\"" }, { linear, "half, linear" }, { half, "half" },
        { space:blend{ bent = 1.25 }, "bent = 1.25" },
        { space:blend{ bent = 1, thick = 1 }, "bent and thick" },
        { bar, "another mesh" }, { bar_bent, "it takes \"bent\"" },
    },
    size = { 8 * math.floor(0.62 * params.size), params.size },
}
print(("volume of the half: linear %.3f of the rest, pose space %.3f"):format(
    linear:volume() / arm:volume(), half:volume() / arm:volume()))
print(("morph targets: greatest error %.3f of the size, with correctives %.3f"):format(
    report.linear_error / arm:size(), report.error / arm:size()))
assert(report.error < 0.5 * report.linear_error)
assert(math.abs(half:volume() / arm:volume() - 1) < 0.08)
assert(linear:volume() < half:volume())
