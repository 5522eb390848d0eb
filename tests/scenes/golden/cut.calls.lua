-- What was done with tools, as calls.
local lissom = require "lissom"

local scene = assert(dofile("cactus.lua"))
scene:step("cut", function()
    local cactus = scene:get("cactus")
    local mesh, mesh2, cut = cactus:cut{ plane = { loops = "nearest", normal = { 0.3800591222640979, -0.8817087494778784, 0.27954381530987144 }, point = { 0.08290358810628637, 0.5695975619198624, 0.1534076781614613 } } }
    mesh:remove_region("selected")
    scene:add("cactus 2", mesh, { style = { boundaries = false, crease = 50, handles = true, level = 1, line_width = 4, region = "", shading = "smooth", vertex_colors = true, wire = false, wire_width = 1 }, transform = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } } })
    mesh2:remove_region("selected")
    scene:add("cactus 3", mesh2, { style = { boundaries = false, crease = 50, handles = true, level = 1, line_width = 4, region = "", shading = "smooth", vertex_colors = true, wire = false, wire_width = 1 }, transform = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } } })
    scene:set("cactus", { visible = false })
end)
assert(scene:hash() == "28f8eed968baac4c")
return scene
