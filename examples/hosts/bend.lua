--- Bends a mesh by sliders: one region stays, another turns.
local lissom = require "lissom"

local p = lissom.params{
    mesh = { type = "mesh", default = "", help = "the mesh; empty: a cactus" },
    base = { type = "region", default = "base", of = "mesh", help = "the vertices that stay" },
    tip = { type = "region", default = "tip", of = "mesh", help = "the vertices that are turned" },
    angle = { type = "number", default = 60, min = -180, max = 180, unit = "degrees",
        help = "turn of the tip" },
    twist = { type = "number", default = 0, min = -360, max = 360, unit = "degrees",
        help = "twist of the tip" },
}
local mesh = p.mesh == "" and lissom.shapes.cactus{ vertices = 3000 } or lissom.load(p.mesh)
local deformer = lissom.deformer(mesh)
deformer:pin(mesh:region(p.base))
local tip = deformer:add_handle(mesh:region(p.tip))
tip:rotate("y", p.twist)
tip:rotate("z", p.angle)
deformer:solve()
return mesh
