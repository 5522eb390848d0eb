-- When to choose sliding pins: parts that keep to something as they move: feet on a floor, a hem on a
-- table, a hand at its distance from a post. A pin of a plane, a line or a sphere takes one or two freedoms
-- of a vertex and leaves the others to the surface.
--
--     lissom run examples/deform/pins.lua

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    bend = { type = "number", default = 60, min = -90, max = 90, unit = "degrees",
        help = "turn of the right end" },
    size = { type = "integer", default = 330, min = 80, help = "height of the picture in pixels" },
    out = { type = "folder", default = "out", help = "folder that the files go to" },
}

-- A beam that lies along x.
local beam = lissom.shapes.bar{ across = 10, along = 60 }
    :transform{ rotate = { axis = "z", angle = 90 } }
local under = beam:region{ box = { min = { -0.3, -0.51, -0.6 }, max = { 0.3, -0.49, 0.6 } } }

-- The beam with its right end turned down, and pins in its middle.
local function bent(pins)
    local mesh = beam:copy()
    local deformer = lissom.deformer(mesh):pin(mesh:region("top"))
    deformer:add_handle(mesh:region("bottom"))
        :rotate{ axis = "z", angle = -params.bend }:translate(-0.6, -1.2, 0)
    local _, left = deformer:solve{ pins = pins }
    assert(not pins or left < 1e-6)
    return mesh
end

local floor, post = {}, {}
for _, v in ipairs(under:vertices()) do
    local _, _, z = beam:position(v)
    table.insert(floor, { vertex = v, plane = { point = { 0, -0.2, 0 }, normal = "y" } })
    table.insert(post, { vertex = v, sphere = { center = { 0, -1.3, z }, radius = 1.1 } })
end

figures.write{
    name = "pins", out = params.out, columns = 4, fit = "all", view = "front",
    panels = {
        { beam, "rest" }, { bent(), "no pins" }, { bent(floor), "its underside slides on a plane" },
        { bent(post), "it keeps its distance from a post" },
    },
    size = { 4 * params.size, params.size },
}
