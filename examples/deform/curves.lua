-- When to choose curves: tails, tentacles and ropes, whose bones lie along a drawn curve (spline IK); brows
-- and lips, where a line on the surface is drawn anew and the surface near it follows (a wire).
--
--     lissom run examples/deform/curves.lua

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    twist = { type = "number", default = 180, min = -720, max = 720, unit = "degrees",
        help = "turn of the rope about its curve" },
    size = { type = "integer", default = 330, min = 80, help = "height of the picture in pixels" },
    out = { type = "folder", default = "out", help = "folder that the files go to" },
}

-- A rope with ridges along it, so that a turn about it is seen.
local rope = lissom.shapes.cylinder{ radius = 0.26, height = 6, segments = 48, rings = 240, cap_rings = 8 }
for i = 1, #rope do
    local x, y, z = rope:position(i)
    local ridge = 1 + 0.12 * math.cos(6 * math.atan(z, x))
    if math.abs(y) < 2.98 then rope:set_position(i, x * ridge, y, z * ridge) end
end

local joints = {}
for i = 0, 16 do joints[i + 1] = { 0, -2.8 + 0.35 * i, 0 } end
local curve = lissom.polyline{ points = {
    { 0, -2.8, 0 }, { -0.9, -1.5, 0.2 }, { 0, 0, 0 }, { 0.9, 1.5, -0.2 }, { 0, 2.8, 0 } } }

-- The rope along the curve.
local function along(options)
    local mesh = rope:copy()
    local deformer = lissom.deformer(mesh)
    deformer:add_bones{ joints = joints, share = 0.15 }:follow(curve:points(), options)
    deformer:solve()
    return mesh
end

-- A wire on a sheet: a line that is drawn anew.
local sheet = lissom.shapes.grid{ size = { 6, 6 }, segments = { 80, 80 } }
    :transform{ rotate = { axis = "x", angle = 90 } }
local wire, edited = {}, {}
for i = 0, 12 do
    local x = -2 + 4 * i / 12
    wire[i + 1] = { x, 0, 0 }
    edited[i + 1] = { x, 0.5 * math.sin(1.5 * x), 0.9 * math.cos(math.pi * x / 5) }
end
local waved = sheet:copy()
local deformer = lissom.deformer(waved):pin(waved:region("border"))
deformer:add_bones{ joints = wire, radius = 0.12, share = 1 }:follow(edited, { stretch = true })
deformer:solve()

figures.write{
    name = "curves", out = params.out, columns = 4, fit = "each", view = "front",
    panels = {
        { rope, "rest" }, { along{}, "along a curve" },
        { along{ stretch = true, twist = params.twist },
            string.format("stretched, twisted by %.0f degrees", params.twist) },
        { waved, "a wire on a sheet" },
    },
    size = { 4 * params.size, params.size },
}
