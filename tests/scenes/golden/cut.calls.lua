-- What was done with tools, as calls.
local lissom = require "lissom"

local scene = assert(dofile("cactus.lua"))
scene:step("cut", function()
    local cactus = scene:get("cactus")
    local mesh, mesh2, cut = cactus:cut{ plane = { loops = "nearest", normal = { 0.38005912226409877, -0.8817087494778779, 0.27954381530987105 }, point = { 0.14351300046113952, 0.5768253480552035, 0.09380214631604024 } } }
    mesh:remove_region("selected")
    scene:add("cactus 2", mesh, { style = { boundaries = false, crease = 50, handles = true, level = 1, line_width = 4, region = "", shading = "smooth", vertex_colors = true, wire = false, wire_width = 1 }, transform = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } } })
    mesh2:remove_region("selected")
    scene:add("cactus 3", mesh2, { style = { boundaries = false, crease = 50, handles = true, level = 1, line_width = 4, region = "", shading = "smooth", vertex_colors = true, wire = false, wire_width = 1 }, transform = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } } })
    scene:set("cactus", { visible = false })
end)
assert(scene:hash() == "9a93d377f29f1e7b")
return scene
