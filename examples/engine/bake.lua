-- Files of a deformation for engines: a cactus that sways, as an animation that any viewer of glTF files
-- plays, and its handle basis, with which a game moves the handles itself.
--
--     lissom run examples/engine/bake.lua
--     lissom run examples/engine/bake.lua --swing 40 --fps 30
--
-- Writes OUT/cactus_sway.glb, the animation; OUT/cactus.glb, the model at rest; and OUT/cactus.basis, which
-- evaluate.c and basis.vert in this folder read.
local lissom = require "lissom"

local params = lissom.params{
    swing = { type = "number", default = 25, min = -60, max = 60, unit = "degrees",
        help = "how far the tip sways" },
    duration = { type = "number", default = 2, min = 0.1, max = 10, unit = "s", help = "of one swing" },
    fps = { type = "integer", default = 12, min = 1, max = 60, help = "frames a second" },
    vertices = { type = "integer", default = 3000, min = 2000, max = 200000, help = "of the cactus" },
    out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
}

local cactus = lissom.shapes.cactus{ vertices = params.vertices }
local deformer = lissom.deformer(cactus)
deformer:add_handle(cactus:region("base"))
local tip = deformer:add_handle(cactus:region("tip"))
local arm = deformer:add_handle(cactus:region("left_tip"))

-- The function places the handles for one moment. They end in their first places.
local function pose(time)
    local phase = 2 * math.pi * time / params.duration
    tip:set{ rotate = { axis = "z", angle = params.swing * math.sin(phase), about = { 0, 0.5, 0 } } }
    arm:set{ rotate = { axis = "z", angle = params.swing * math.sin(phase - 0.6), about = { 0, 0.5, 0 } } }
end

local sway = deformer:bake{ pose = pose, duration = params.duration, fps = params.fps, name = "sway" }
sway:save(params.out .. "/cactus_sway.glb")

-- Handles are called as the regions that they are made of: "base", "tip", "left_tip".
deformer:save_basis(params.out .. "/cactus.basis")

-- Files for engines repeat vertices at seams of texture coordinates: each carries its row of the basis.
local rows = {}
for i, vertex in ipairs(deformer:region():vertices()) do rows[vertex] = i - 1 end -- rows count from 0
for vertex = 1, #cactus do rows[vertex] = rows[vertex] or -1 end
cactus:add_attribute{ name = "BASIS_ROW", domain = "vertex", width = 1, values = rows }
cactus:save(params.out .. "/cactus.glb")

print(string.format("%d vertices, %d frames: %s/cactus_sway.glb, %s/cactus.glb, %s/cactus.basis",
    #cactus, math.floor(params.duration * params.fps + 0.5) + 1, params.out, params.out, params.out))
