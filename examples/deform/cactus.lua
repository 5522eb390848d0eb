-- Bends a cactus: the trunk sweeps over, the arms open, and the foot holds its place.
--
--     lissom run examples/deform/cactus.lua
--     lissom run examples/deform/cactus.lua --bend 90 --vertices 40000 --out /tmp

local before_after = require "before_after"
local lissom = require "lissom"

local params = lissom.params{
    bend = { type = "number", default = 65, min = -180, max = 180, unit = "degrees",
        help = "how far the trunk bends to the right" },
    open = { type = "number", default = 55, min = -120, max = 120, unit = "degrees",
        help = "how far the arms open outwards" },
    vertices = { type = "integer", default = 20000, min = 2000, max = 1000000,
        help = "vertices of the cactus" },
    out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
}

-- The generated cactus stands on y = 0 and comes with names for its parts: "tip", "left_tip", ...
local rest = lissom.shapes.cactus{ vertices = params.vertices }
local height = rest:bounds().max[2]

-- Only vertices of the region move: here all but the foot.
rest:set_region("movable", rest:region{ plane = { point = { 0, 0.15 * height, 0 }, normal = { 0, 1, 0 } } })

-- A copy has the same vertices and the same names.
local mesh = rest:copy()
local deformer = lissom.deformer(mesh, { region = mesh:region("movable") })

-- A handle takes its vertices along and turns the surface there; the part between the handles follows. Turned
-- about a point of the trunk, the tip moves along an arc.
local tip = deformer:add_handle(mesh:region("tip"))
tip:rotate{ axis = "z", angle = -params.bend, about = { 0, 0.6 * height, 0 } }

-- The arms open about their elbows: `side` is the sign of x.
local function open_arm(name, side)
    local arm = deformer:add_handle(mesh:region(name))
    arm:rotate{ axis = "z", angle = -side * params.open, about = { side * 0.2 * height, 0.45 * height, 0 } }
end
open_arm("left_tip", -1)
open_arm("right_tip", 1)

deformer:solve()

-- Before and after, side by side: the region in blue, the handles in purple.
local file = before_after.write{
    name = "cactus", out = params.out, before = rest, after = mesh,
    view = "front", region = "movable", handles = { "tip", "left_tip", "right_tip" }, size = { 960, 520 },
}
print(string.format("%d vertices, %d of them free: %s, .ply, .png",
    mesh:vertex_count(), deformer:stats().free_vertices, file))
