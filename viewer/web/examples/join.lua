-- A head grows out of a cactus: both are cut, and merged into one closed surface.
local lissom = require "lissom"

local p = lissom.params{
    turn = { type = "number", default = 20, min = -90, max = 90, unit = "degrees",
        help = "direction of the gaze" },
    height = { type = "number", default = 1.7, min = 1.2, max = 2.2,
        help = "height of the cut through the cactus" },
}

local head = lissom.shapes.head{ vertices = 8000 }
head = head:cut{ plane = { point = { 0, -0.15, 0 }, normal = { 0, 1, 0 }, seed = { 0, 0.1, 0 } } }
head:transform{ rotate = { axis = "y", angle = p.turn } }
local cactus = lissom.shapes.cactus{ vertices = 8000, ribs = 0 }
cactus = cactus:cut{ plane = { point = { 0, p.height, 0 }, normal = { 0, -1, 0 } } }

local mesh, report = lissom.merge(head, cactus)
print("closed: " .. tostring(mesh:is_closed()), string.format("scale: %.2f", report.joins[1].scale))
print(report.verdict)
return mesh
