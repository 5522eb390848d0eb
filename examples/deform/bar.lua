-- Bends and twists a bar: one end holds its place, the other goes round.
--
--     lissom run examples/deform/bar.lua
--     lissom run examples/deform/bar.lua --twist 180 --bend 0

local lissom = require "lissom"

local params = lissom.params{
    bend = { type = "number", default = 90, min = -180, max = 180, unit = "degrees",
        help = "how far the upper end turns over" },
    twist = { type = "number", default = 90, min = -360, max = 360, unit = "degrees",
        help = "how far the upper end turns about the bar's own axis" },
    across = { type = "integer", default = 12, min = 2, max = 60, help = "quads across each side" },
    out = { type = "string", default = "out", help = "folder that the files go to" },
}

local length, width = 6, 1
local rest = lissom.shapes.bar{
    length = length, width = width, across = params.across, along = length * params.across,
}

-- The ends are squares; grown to slabs, they make the surface leave them straight.
for _, name in ipairs{ "bottom", "top" } do
    rest:set_region(name, rest:region(name):grow(params.across // 2))
end

-- Without a region the whole mesh may move. The lower handle is not moved: it holds its place.
local mesh = rest:copy()
local edit = lissom.deform(mesh)
edit:handle(mesh:region("bottom"))
local top = edit:handle(mesh:region("top"))

-- Moves add up in the order of the calls: first the twist about the bar's axis, then the turn about a
-- point beside the bar's middle.
top:rotate{ axis = "y", angle = params.twist }
top:rotate{ axis = "z", angle = -params.bend, about = { 2 * width, 0, 0 } }

assert(edit:solve())

-- Before and after, with the faces' edges: the handles in purple.
local function path(extension) return params.out .. "/bar." .. extension end
assert(mesh:save(path("obj")))
assert(mesh:save(path("ply")))
assert(lissom.render{
    meshes = { rest, mesh }, columns = 2, wire = true, region = rest:region{ all = true },
    handles = { "bottom", "top" }, file = path("png"), size = { 1200, 640 },
})
print(string.format("%d vertices, %d of them free: %s, .ply, .png",
    mesh:vertex_count(), edit:stats().free_vertices, path("obj")))
