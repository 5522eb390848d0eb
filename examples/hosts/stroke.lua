--- A tool that raises a ridge along a stroke, and a stroke with it.
local lissom = require "lissom"

local p = lissom.params{
    mesh = { type = "mesh", default = "", help = "the mesh; empty: a ball" },
    height = { type = "number", default = 0.1, min = -1, max = 1,
        help = "of the ridge, times the size of the mesh" },
    width = { type = "number", default = 0.2, min = 0.02, max = 1,
        help = "of the ridge, times the size of the mesh" },
}

-- Raises the surface around points, the more the nearer the nearest of them is.
local function raise(mesh, points)
    local radius, height = p.width * mesh:size(), p.height * mesh:size()
    local moved = {}
    for v = 1, #mesh do
        local x, y, z = mesh:position(v)
        local near = 0
        for _, q in ipairs(points) do
            local dx, dy, dz = x - q[1], y - q[2], z - q[3]
            near = math.max(near, 1 - (dx * dx + dy * dy + dz * dz) / (radius * radius))
        end
        local nx, ny, nz = mesh:normal(v)
        local lift = height * near * near
        moved[v] = { x + lift * nx, y + lift * ny, z + lift * nz }
    end
    for v, q in ipairs(moved) do mesh:set_position(v, q[1], q[2], q[3]) end
end

local tool = lissom.tool{
    name = "ridge",
    press = function(self) self.points = {} end,
    drag = function(self, ev)
        local hit = ev:hit()
        if hit then table.insert(self.points, hit.position) end
    end,
    release = function(self, ev) raise(ev.scene:get("mesh"), self.points) end,
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
    eye = { bounds.center[1], bounds.center[2], bounds.center[3] + bounds.diagonal } }
local host = lissom.tool_host{ scene = scene, camera = camera, tool = tool, size = { 640, 480 } }
host:press{ x = 230, y = 220 }
for i = 1, 36 do host:move{ x = 230 + 5 * i, y = 220 + 40 * math.sin(i / 5) } end
host:release{ x = 410, y = 250 }
return scene:get("mesh")
