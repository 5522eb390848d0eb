--- A tool that raises a ridge along a stroke, and a stroke with it.
local lissom = require "lissom"

local p = lissom.params{
    mesh = { type = "mesh", default = "", help = "the mesh; empty: a ball" },
    height = { type = "number", default = 0.1, min = -1, max = 1,
        help = "of the ridge, times the size of the mesh" },
    width = { type = "number", default = 0.25, min = 0.02, max = 1,
        help = "of the ridge, times the size of the mesh" },
}

-- Raises the surface around a point, the more the nearer.
local function raise(mesh, point, size)
    local radius = p.width * size
    for _, v in ipairs(mesh:region{ sphere = { center = point, radius = radius } }:vertices()) do
        local x, y, z = mesh:position(v)
        local dx, dy, dz = x - point[1], y - point[2], z - point[3]
        local near = 1 - (dx * dx + dy * dy + dz * dz) / (radius * radius)
        local n, lift = { mesh:normal(v) }, 0.2 * p.height * size * near * near
        mesh:set_position(v, x + lift * n[1], y + lift * n[2], z + lift * n[3])
    end
end

local tool = lissom.tool{
    name = "ridge",
    press = function(self, ev) self.size = ev.scene:get("mesh"):size() end,
    drag = function(self, ev)
        local hit = ev:hit()
        if hit then raise(hit.mesh, hit.position, self.size) end
    end,
}

local mesh
if p.mesh == "" then
    mesh = lissom.shapes.sphere{ segments = 24, kind = "triangles" }
else
    mesh = lissom.load(p.mesh)
end
local bounds, scene = mesh:bounds(), lissom.scene{}
scene:add("mesh", mesh)
local camera = lissom.camera{ target = bounds.center,
    eye = { bounds.center[1], bounds.center[2], bounds.center[3] + 2 * bounds.diagonal } }
local host = lissom.tool_host{ scene = scene, camera = camera, tool = tool, size = { 640, 480 } }
host:press{ x = 270, y = 220 }
for i = 1, 20 do host:move{ x = 270 + 5 * i, y = 220 + 25 * math.sin(i / 3) } end
host:release{ x = 370, y = 240 }
return scene:get("mesh")
