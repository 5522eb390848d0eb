-- A skinned file of a deformation: a cactus that sways, by joints that any engine and any viewer of glTF
-- files moves; and its animation by morph targets, compressed.
--
--     lissom run examples/engine/skin.lua
--     lissom run examples/engine/skin.lua --joints 20
--
-- Writes OUT/cactus_skin.glb and OUT/cactus_small.glb, and prints how far the skin is from the deformation.
local lissom = require "lissom"

local params = lissom.params{
    swing = { type = "number", default = 35, min = -90, max = 90, unit = "degrees",
        help = "how far the tip sways" },
    joints = { type = "integer", default = 12, min = 1, max = 250, help = "joints of the skin" },
    bits = { type = "integer", default = 12, min = 6, max = 20,
        help = "bits of positions in the compressed file" },
    vertices = { type = "integer", default = 3000, min = 2000, max = 200000, help = "of the cactus" },
    out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
}

local cactus = lissom.shapes.cactus{ vertices = params.vertices }
local deformer = lissom.deformer(cactus)
deformer:add_handle(cactus:region("base"))
local tip = deformer:add_handle(cactus:region("tip"))

local function pose(time)
    tip:set{ rotate = { axis = "z", angle = params.swing * math.sin(math.pi * time), about = { 0, 0.5, 0 } } }
end

local skinned, report = deformer:skin{ joints = params.joints, pose = pose, duration = 2, fps = 12 }
skinned:save(params.out .. "/cactus_skin.glb")
print(string.format("%d joints: the greatest error is %.2f %% of the size, the mean one %.3f %%",
    report.joints, 100 * report.max_error / cactus:size(), 100 * report.rms_error / cactus:size()))

local baked = deformer:bake{ pose = pose, duration = 2, fps = 12, name = "sway" }
local done, problem = pcall(baked.save, baked, params.out .. "/cactus_small.glb",
    { compression = "meshopt", quantize = params.bits })
-- A build without the codec says which package it needs.
print(done and "compressed: cactus_small.glb" or tostring(problem))
