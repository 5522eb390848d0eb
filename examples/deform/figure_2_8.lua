-- The end of a tail is moved far, but not turned (Figure 2.8): methods that propagate turns of handles have
-- none to propagate, so details keep their direction in space while the tail rises; the implicit method turns
-- them along with it.
--
--     lissom run examples/deform/figure_2_8.lua
--     lissom run examples/deform/figure_2_8.lua --mesh dinosaur.obj
--
-- A model given as `mesh` is taken to be upright along y, with its tail towards +x and its feet below.

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    mesh = { type = "file", default = "", help = "the dinosaur, instead of the generated tail" },
    rise = { type = "number", default = 1, min = 0, max = 1.5, help = "factor of the distance" },
    rings = { type = "integer", default = 120, min = 60, max = 600, help = "rings of the generated tail" },
    out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
}

local joints = 10

-- A tail along +x that thins out and sinks, with a row of plates on its back, on a round body.
local function tail()
    local mesh = lissom.shapes.cylinder{ radius = 1, height = 1, segments = 32, rings = params.rings }
    local positions, place = mesh:positions(), {}
    for v = 1, #mesh do
        local x, y, z = positions[3 * v - 2], positions[3 * v - 1], positions[3 * v]
        local t = y + 0.5
        place[v] = t
        local plate = math.max(0, math.sin(2 * math.pi * joints * t)) ^ 2 * math.max(0, x) ^ 12
        local radius = (0.45 * (1 - t) ^ 0.8 + 0.05) * (1 + 0.7 * plate)
        positions[3 * v - 2] = 4 * t + 0.3 * radius * x * math.cos(math.pi * t / 2)
        positions[3 * v - 1] = -0.5 * math.sin(math.pi * t / 2) + radius * x
        positions[3 * v] = radius * z
    end
    mesh:flip()
    local function between(low, high)
        return mesh:region{ where = function(v) return place[v] >= low and place[v] <= high end }
    end
    mesh:set_region("root", between(0, 0.08)):set_region("end", between(0.93, 1))
    return mesh, { "root" }, { -0.9, 3.2 }, function(k) return between(k / joints, (k + 0.5) / joints) end
end

-- The dinosaur: feet and head hold.
local function dinosaur()
    local mesh = lissom.load(params.mesh)
    local box = mesh:bounds()
    local function slab(low, high)
        return mesh:region{ box = {
            min = { box.min[1] + low * (box.max[1] - box.min[1]), box.min[2], box.min[3] },
            max = { box.min[1] + high * (box.max[1] - box.min[1]), box.max[2], box.max[3] },
        } }
    end
    local height = box.max[2] - box.min[2]
    local ankle = box.min[2] + 0.14 * height
    local feet = mesh:region{ plane = { point = { 0, ankle, 0 }, normal = { 0, -1, 0 } } }
    mesh:set_region("feet", feet:minus(slab(0.55, 1))):set_region("end", slab(0.94, 1))
    mesh:set_region("head", slab(0, 0.2):minus(mesh:region{
        plane = { point = { 0, box.min[2] + 0.8 * height, 0 }, normal = { 0, -1, 0 } } }))
    return mesh, { "feet", "head" }, { 0, 0.62 * (box.max[1] - box.min[1]) },
        function(k) return slab(0.64 + 0.029 * k, 0.64 + 0.029 * (k + 1)) end
end

local rest, held, offset, joint = (params.mesh == "" and tail or dinosaur)()
local handles, names = {}, { "end" }
handles["end"] = function(handle)
    handle:translate(params.rise * offset[1], params.rise * offset[2], 0)
end
for _, name in ipairs(held) do
    handles[name] = figures.hold
    table.insert(names, name)
end

-- The spine at joint k runs from the joint before to the one after; its plate stands from the lower half of
-- the joint to the upper.
local spines, plates = {}, {}
for k = 1, joints - 2 do
    local here = joint(k)
    local middle = here:center()[2]
    local upper = here:minus(rest:region{ plane = { point = { 0, middle, 0 }, normal = { 0, -1, 0 } } })
    table.insert(spines, { joint(k - 1), joint(k + 1) })
    table.insert(plates, { here:minus(upper), upper })
end

-- How far spine and plates turned, and how far the angle between them changed: means in degrees.
local function measure(mesh)
    local spine_turn, plate_turn, lean = 0, 0, 0
    for k = 1, #spines do
        spine_turn = spine_turn + figures.bearing(rest, mesh, table.unpack(spines[k])) / #spines
        plate_turn = plate_turn + figures.bearing(rest, mesh, table.unpack(plates[k])) / #spines
        local before = figures.angle_between(rest, spines[k], plates[k])
        lean = lean + math.abs(figures.angle_between(mesh, spines[k], plates[k]) - before) / #spines
    end
    return spine_turn, plate_turn, lean
end

local panels, lean, plate = { { rest, "at rest" } }, {}, {}
figures.row("method", "%10s %10s %10s %10s", "spine", "plates", "lean", "stretch 99 %")
local methods = { "naive", "geodesic", "harmonic", "frames", "rotation_estimate", "similarity", "implicit" }
for _, method in ipairs(methods) do
    local mesh = figures.deformed(rest, { method = method }, handles)
    local spine_turn, plate_turn, leaning = measure(mesh)
    lean[method], plate[method] = leaning, plate_turn
    figures.row(method, "%10.1f %10.1f %10.1f %10.2f", spine_turn, plate_turn, leaning,
        figures.anisotropy(rest, mesh).p99)
    if method ~= "naive" and method ~= "geodesic" then table.insert(panels, { mesh, method }) end
end
print("degrees that spine and plates turned, and that their angle changed; anisotropy of triangles")

figures.write{
    name = "figure_2_8", out = params.out, panels = panels, columns = 3, size = { 1500, 1000 },
    view = "front", handles = names,
}
for _, method in ipairs{ "geodesic", "harmonic", "frames" } do
    figures.claim(plate[method] < 0.4 * plate.implicit, "details do not turn in method " .. method)
    figures.claim(lean.implicit < 0.6 * lean[method], "details lean less than in method " .. method)
end
