-- Writes shapes and models as OBJ and GLB, for Blender to open. Texture coordinates (u, v) are (x, y), and
-- (x + 2, y) on every second face, so that there are seams.
local lissom = require "lissom"

local params = lissom.params{
   out = { type = "string", default = "out", help = "folder for the files" },
   models = { type = "string", default = "", help = "folder with models, each saved as it is read" },
}

local function add_seams(mesh)
   local uvs = {}
   for f = 1, mesh:face_count() do
      for _, v in ipairs(mesh:face(f)) do
         local x, y = mesh:position(v)
         uvs[#uvs + 1] = x + (f % 2 == 0 and 2 or 0)
         uvs[#uvs + 1] = y
      end
   end
   mesh:add_attribute{ name = "uv", domain = "corner", width = 2, values = uvs }
   return mesh
end

local function save(mesh, name)
   for _, extension in ipairs{ "obj", "glb" } do
      assert(mesh:save(string.format("%s/%s.%s", params.out, name, extension)))
   end
end

local shapes = lissom.shapes
save(add_seams(shapes.sphere{ segments = 12 }), "shape_sphere")
save(add_seams(shapes.cylinder{ caps = true }), "shape_cylinder")
save(add_seams(shapes.grid{ segments = { 7, 5 } }), "shape_grid")
save(add_seams(shapes.torus{}), "shape_torus")
save(shapes.cactus{ vertices = 2000 }, "cactus")

-- A skin, whose joints are animated.
local bar = shapes.bar{ across = 2, along = 10 }
local deformer = lissom.deformer(bar)
deformer:add_handle(bar:region("bottom"))
local top = deformer:add_handle(bar:region("top"))
local skinned = deformer:skin{ joints = 4, duration = 1, fps = 8, pose = function(time)
   top:set{ rotate = { axis = "z", angle = 60 * time } }
end }
assert(skinned:save(params.out .. "/bar_skin.glb"))

-- Models without two vertices at one place, which Blender would join.
local names = { "camelhead.off", "fandisk_quads.off", "bunny_3k.off", "eight.off", "hand_plain.obj" }
for _, name in ipairs(params.models ~= "" and names or {}) do
   local mesh, message = lissom.load(params.models .. "/" .. name)
   if mesh then
      save(mesh, (name:gsub("%..*", "")))
   else
      print("skipped: " .. message)
   end
end
