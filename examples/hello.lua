-- Bends a cactus: the library in one page. Run it with
--     lissom run examples/hello.lua

local lissom = require "lissom"

local cactus = lissom.shapes.cactus{}
local edit = lissom.deform(cactus)

-- A handle holds its vertices at its transform; one that is not moved holds its place.
edit:handle(cactus:region("base"))
local tip = edit:handle(cactus:region("tip"))

-- Moves add up, and each solve uses factors that were made once.
for _ = 1, 3 do
    tip:rotate{ axis = "z", angle = 20 }
    edit:solve()
end

cactus:save("hello.obj")
local stats = edit:stats()
print(string.format("bent %d vertices with %d factorizations, wrote hello.obj",
    stats.free_vertices, stats.factorizations))
