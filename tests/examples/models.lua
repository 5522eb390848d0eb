-- The models that the examples in C read.
local lissom = require "lissom"

local p = lissom.params{ out = { type = "folder", default = "out", help = "Where the models go." } }

local models = {
    ball = lissom.shapes.sphere{},
    egg = lissom.shapes.sphere{}:transform{ scale = { 1, 1.4, 1 } },
    head = lissom.shapes.head{},
}
for name, mesh in pairs(models) do assert(mesh:save(p.out .. "/" .. name .. ".obj")) end
