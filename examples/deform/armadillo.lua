-- Poses a scanned model: the feet hold their place, one arm is raised, the other lowered, the head turns.
--
--     lissom run examples/deform/armadillo.lua --model armadillo.obj
--     lissom run examples/deform/armadillo.lua --model armadillo.obj --raise 30 --turn 40
--
-- It expects the armadillo of the Stanford 3D Scanning Repository upright along y, facing +z.

local before_after = require "before_after"
local lissom = require "lissom"

local params = lissom.params{
    model = { type = "file", default = "../shared/data/models/armadillo_43k.obj",
        help = "mesh of the armadillo" },
    raise = { type = "number", default = 50, min = -60, max = 60, unit = "degrees",
        help = "how far its left arm is raised and its right arm lowered" },
    turn = { type = "number", default = -35, min = -90, max = 90, unit = "degrees",
        help = "how far the head turns to its left" },
    out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
}

local rest = lissom.load(params.model)

-- Points are given as fractions of the bounding box, lengths in the size of the surface.
local box, size = rest:bounds(), rest:size()
local function at(x, y, z)
    local function mix(i, f) return box.min[i] + f * (box.max[i] - box.min[i]) end
    return { mix(1, x), mix(2, y), mix(3, z) }
end
local function ball(center, radius)
    return rest:region{ sphere = { center = center, radius = radius * size } }
end

-- Everything above the ankles may move; hands and head are handles.
rest:set_region("movable", rest:region{ plane = { point = at(0.5, 0.1, 0.5), normal = { 0, 1, 0 } } })
rest:set_region("left_hand", ball(at(0.97, 0.83, 0.87), 0.36))
rest:set_region("right_hand", ball(at(0.05, 0.86, 0.87), 0.36))
rest:set_region("head", ball(at(0.52, 0.82, 0.75), 0.4))

local mesh = rest:copy()
local deformer = lissom.deformer(mesh, { region = mesh:region("movable") })

-- Arms turn about the shoulders, the head about the neck.
deformer:add_handle(mesh:region("left_hand")):rotate("z", params.raise, { about = at(0.70, 0.72, 0.5) })
deformer:add_handle(mesh:region("right_hand")):rotate("z", params.raise, { about = at(0.30, 0.72, 0.5) })
deformer:add_handle(mesh:region("head")):rotate("y", params.turn, { about = at(0.5, 0.8, 0.5) })

deformer:solve()

local file = before_after.write{
    name = "armadillo", out = params.out, before = rest, after = mesh,
    view = "front", region = "movable", handles = { "left_hand", "right_hand", "head" }, size = { 1200, 720 },
}
local stats = deformer:stats()
print(string.format("%d vertices, %d of them free, prepared in %.2f s: %s, .ply, .png", mesh:vertex_count(),
    stats.free_vertices, stats.assemble_seconds + stats.first_factor_seconds + stats.second_factor_seconds,
    file))
