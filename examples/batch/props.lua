-- Writes a folder of models, for the other examples of batches.
--
--     lissom run examples/batch/props.lua --out out/props
local lissom = require "lissom"

local params = lissom.params{
    out = { type = "folder", default = "out/props", help = "folder that the models go to" },
}

local shapes = lissom.shapes
local models = {
    cactus = shapes.cactus{ vertices = 3000 },
    post = shapes.bar{ length = 6, width = 1, across = 4, along = 24 },
    egg = shapes.sphere{}:transform{ scale = { 1, 1.8, 1 } },
}
for name, mesh in pairs(models) do mesh:save(params.out .. "/" .. name .. ".obj") end
