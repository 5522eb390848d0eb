-- A merge in three steps: two models, the parts that are cut from them with the boundaries that meet, and the
-- surface that they become. The head is 40 cm high and stands anywhere; the cactus is two units high.
--
--     lissom run examples/merge/steps.lua
--     lissom run examples/merge/steps.lua --turn 30 --size 800 --out /tmp

local lissom = require "lissom"
local merge_pictures = require "merge_pictures"

local params = lissom.params{
    turn = { type = "number", default = 0, min = -180, max = 180, unit = "degrees",
        help = "how far the head looks to its left" },
    size = { type = "integer", default = 480, min = 64, max = 4096, unit = "pixels", help = "of a step" },
    out = { type = "folder", default = "out", help = "folder that the files go to" },
}

-- 1. Two models.
local head = lissom.shapes.head{ vertices = 40000 }
local cactus = lissom.shapes.cactus{ ribs = 0, vertices = 20000 }
local models = { head:copy(), cactus:copy() }

-- 2. Each is cut along a smooth line through its faces; the part with the seed stays.
head = head:cut{ plane = { point = { 0, -0.15, 0 }, normal = { 0, 1, 0 }, seed = { 0, 0.1, 0 } } }
cactus = cactus:cut{ plane = { point = { 0, 1.7, 0 }, normal = { 0, -1, 0 } } }
local from, to = head:boundaries()[1], cactus:boundaries()[1]
local angle = math.rad(params.turn)
local front = { from:nearest(0, 0, 1).position, to:nearest(math.sin(angle), 0, math.cos(angle)).position }

-- 3. The head is turned, scaled and deformed so that the boundaries meet; the cactus stays.
local mesh, report = lissom.merge{
    source = head, target = cactus, joins = { { source = from, target = to, keys = { front } } },
}
assert(mesh:is_closed() and mesh:is_manifold())
print(string.format("%d vertices meet %d, scale %.3g, greatest angle at the seam %.1f degrees",
    report.joins[1].source_size, report.joins[1].target_size, report.joins[1].scale,
    report.seam.after.max_dihedral))

-- Blue stays, sand is deformed. Before they meet, the head stands beside the cactus, as large as it will be.
local function painted(part, color)
    local copy = part:copy()
    for _, name in ipairs{ "color", "normal" } do copy:remove_attribute(name) end
    local colors = copy:add_attribute{ name = "color", domain = "vertex", width = 4 }
    for i = 1, 4 * #copy do colors[i] = color[(i - 1) % 4 + 1] end
    return copy
end
local function side_by_side(stays, moves)
    local scale = report.joins[1].scale
    local beside = painted(moves, merge_pictures.sand):transform{ scale = scale,
        translate = { 0.9, 0.6 - scale * moves:bounds().min[2], 0 } }
    return painted(stays, merge_pictures.blue):append(beside)
end
print(lissom.render{
    meshes = { side_by_side(models[2], models[1]), side_by_side(cactus, head),
        merge_pictures.colored(mesh, report) },
    columns = 3, captions = { "two models", "cut", "merged" }, boundaries = true, view = "front",
    size = { 3 * params.size, params.size }, file = params.out .. "/steps.png",
})
mesh:save(params.out .. "/steps.obj")
