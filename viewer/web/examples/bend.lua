-- Drag the sliders: the tips turn, and the whole surface follows.
local lissom = require "lissom"

local p = lissom.params{
    bend = { type = "number", default = 70, min = -160, max = 160, unit = "degrees",
        help = "how far the trunk bends" },
    open = { type = "number", default = 40, min = -90, max = 110, unit = "degrees",
        help = "how far the arms open" },
    thorns = { type = "number", default = 0.06, min = 0, max = 0.2,
        help = "their height, of the trunk's radius" },
}

local cactus = lissom.shapes.cactus{ vertices = 6000, thorns = p.thorns }
local height = cactus:bounds().max[2]

-- A handle takes its vertices along; pinned ones stay; between them the surface keeps its details.
local deformer = lissom.deformer(cactus)
deformer:pin(cactus:region("base"))
deformer:add_handle(cactus:region("tip"))
    :rotate{ axis = "z", angle = -p.bend, about = { 0, 0.6 * height, 0 } }
for name, side in pairs{ left_tip = -1, right_tip = 1 } do
    deformer:add_handle(cactus:region(name))
        :rotate{ axis = "z", angle = -side * p.open, about = { side * 0.2 * height, 0.45 * height, 0 } }
end
deformer:solve()

print(cactus:vertex_count() .. " vertices")
lissom.render{ mesh = cactus, file = "bend.png", view = "front", handles = { "tip", "left_tip", "right_tip" },
    region = "base" }
