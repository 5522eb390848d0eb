-- Bends and twists a bar: one end holds its place, the other goes round.
--
--     lissom run examples/deform/bar.lua
--     lissom run examples/deform/bar.lua --twist 180 --bend 0

local before_after = require "before_after"
local lissom = require "lissom"

local params = lissom.params{
    bend = { type = "number", default = 90, min = -180, max = 180, unit = "degrees",
        help = "how far the upper end turns over" },
    twist = { type = "number", default = 90, min = -360, max = 360, unit = "degrees",
        help = "how far the upper end turns about the bar's own axis" },
    across = { type = "integer", default = 12, min = 2, max = 60, help = "quads across each side" },
    out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
}

local length, width = 6, 1
local rest = lissom.shapes.bar{
    length = length, width = width, across = params.across, along = length * params.across,
}

-- The ends are squares; grown to slabs, they make the surface leave them straight.
for _, name in ipairs{ "bottom", "top" } do
    rest:set_region(name, rest:region(name):grow(params.across // 2))
end

rest:set_region("movable", rest:region{ all = true })

-- Without a region the whole mesh may move. The lower handle is not moved: it holds its place.
local mesh = rest:copy()
local deformer = lissom.deformer(mesh)
deformer:add_handle(mesh:region("bottom"))
local top = deformer:add_handle(mesh:region("top"))

-- Moves add up in the order of the calls: first the twist about the bar's axis, then the turn about a
-- point beside the bar's middle.
top:rotate{ axis = "y", angle = params.twist }
top:rotate{ axis = "z", angle = -params.bend, about = { 2 * width, 0, 0 } }

deformer:solve()

-- Before and after, with the faces' edges: the handles in purple.
local file = before_after.write{
    name = "bar", out = params.out, before = rest, after = mesh,
    wire = true, region = "movable", handles = { "bottom", "top" },
}
print(string.format("%d vertices, %d of them free: %s, .ply, .png",
    mesh:vertex_count(), deformer:stats().free_vertices, file))
