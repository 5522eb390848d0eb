-- Writes small valid files of every format for the fuzzer to start from.
local lissom = require "lissom"

local params = lissom.params{
   out = { type = "string", default = "out", help = "folder for the files" },
}

local shapes = {
   box = lissom.shapes.box{},
   grid = lissom.shapes.grid{ segments = {3, 2} },
   sphere = lissom.shapes.sphere{ segments = 2 },
}
for name, mesh in pairs(shapes) do
   for _, extension in ipairs{ "obj", "ply", "off", "stl", "gltf", "glb" } do
      assert(mesh:save(string.format("%s/%s.%s", params.out, name, extension)))
   end
end
