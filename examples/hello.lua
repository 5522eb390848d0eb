-- Bends a cactus: the library in one page. Run it with
--     lissom run examples/hello.lua

local lissom = require "lissom"

local cactus = lissom.shapes.cactus{}
local deformer = lissom.deformer(cactus)

-- A handle holds its vertices at its transform; one that is not moved holds its place.
deformer:add_handle(cactus:region("base"))
local tip = deformer:add_handle(cactus:region("tip"))

-- Moves add up, and each solve uses factors that were made once.
for _ = 1, 3 do
    tip:rotate{ axis = "z", angle = 20 }
    deformer:solve()
end

cactus:save("hello.obj")
local stats = deformer:stats()
print(string.format("bent %d vertices with %d factorizations, wrote hello.obj",
    stats.free_vertices, stats.factorizations))
