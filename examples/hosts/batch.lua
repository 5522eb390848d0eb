--- One job of a batch: smooths a mesh, and tells its measures. Over many files:
--
--     lissom batch examples/hosts/batch.lua --over 'in/*.obj' --sweep steps=3,9 \
--         --out 'out/{name}_{steps}.glb'
local lissom = require "lissom"

local p = lissom.params{
    mesh = { type = "mesh", default = "", help = "the mesh; empty: a cactus" },
    steps = { type = "integer", default = 10, min = 0, max = 100, help = "steps of smoothing" },
    keep = { type = "boolean", default = true, help = "keeps the volume" },
    out = { type = "file", default = "", help = "file for the result; empty: none" },
}
local mesh = p.mesh == "" and lissom.shapes.cactus{ vertices = 4000 } or lissom.load(p.mesh)
mesh:smooth{ iterations = p.steps, keep_volume = p.keep }
if p.out ~= "" then mesh:save(p.out) end
return mesh, string.format("%d vertices, area %.3f", #mesh, mesh:area())
