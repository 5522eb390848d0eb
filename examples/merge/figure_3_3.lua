-- A cactus whose handle is moved, turned and scaled (Figure 3.3): the rest follows by the same similarity.
-- Here the handle is the foot: the cactus is cut, the foot taken elsewhere, and the upper part merged back
-- to it.
--
--     lissom run examples/merge/figure_3_3.lua
--     lissom run examples/merge/figure_3_3.lua --mesh cactus.off --cut "0, 0.2, 0; 0, 1, 0" --scale 3

local figures = require "figures"
local lissom = require "lissom"
local merge_script = require "merge_script"
local merging = require "merging"

local params = merge_script.params{
    mesh = { type = "file", default = "", help = "a model instead of the generated cactus" },
    cut = { type = "string", default = "0, 0.35, 0; 0, 1, 0",
        help = "\"point; normal\": the side of the normal follows" },
    scale = { type = "number", default = 0.5, min = 0.001, max = 1000, help = "of the handle" },
    turn = { type = "number", default = 70, min = -180, max = 180, unit = "degrees",
        help = "how far the handle turns" },
}

local cactus = params.mesh ~= "" and lissom.load(params.mesh)
    or lissom.shapes.cactus{ vertices = 9000 }
local cut = merging.read_cut(params.cut)
local above, below, lines = cactus:cut{ plane = { point = cut.point, normal = cut.normal } }
local size = cactus:size()

-- The similarity is that of the handle; the source kept its place.
local similarity = {
    scale = params.scale, rotate = { axis = { 0.3, 0.2, 1 }, angle = params.turn },
    translate = { 3 * size, -size, 2 * size },
}
local handle = below:copy():transform(similarity)
local wanted = above:copy():transform(similarity)

-- Pairs that met before meet again. The line of the cut follows the ribs: it turns sharply and is not to be
-- trimmed.
local from, first = lines[1], lines.b[1]
local there = merging.boundary_near(handle, { handle:position(first:vertices()[1]) })
local positions, keys = {}, {}
for _, v in ipairs(first:vertices()) do
    positions[table.concat({ below:position(v) }, " ")] = v
end
for i, v in ipairs(from:vertices()) do
    if i % math.ceil(#from / 4) == 1 then
        table.insert(keys, { v, positions[table.concat({ above:position(v) }, " ")] })
    end
end
local mesh, report, parts = merging.merge({ { source = from, target = there, keys = keys } },
    { smooth = 0, trim = false })
merge_script.finish(params, "figure_3_3", mesh, report, parts, { view = "front" })

-- Expected vertices of the source.
local worst = 0
for v = 1, #mesh do
    local origins = report.provenance:vertex(v)
    if #origins == 1 and origins[1].side == "source" then
        local p, q = { mesh:position(v) }, { wanted:position(origins[1].vertex) }
        for k = 1, 3 do worst = math.max(worst, math.abs(p[k] - q[k])) end
    end
end
worst = worst / wanted:size()
print(string.format("scale %.12g for %.12g, shape off by %.1e of the size", report.joins[1].scale,
    params.scale, worst))
figures.claim(math.abs(report.joins[1].scale / params.scale - 1) < 0.02, "the part takes the handle's scale")
figures.claim(worst < 0.01, "the part follows by the handle's similarity")

-- The same boundary condition given to the deformation: a handle that is moved by the similarity.
local whole = cactus:copy()
local deformer = lissom.deformer(whole, { local_size = "scale" })
local foot = whole:region{ where = function(v)
    local n = cut.normal
    local x, y, z = cactus:position(v)
    return (x - cut.point[1]) * n[1] + (y - cut.point[2]) * n[2] + (z - cut.point[3]) * n[3] < 0
end }
local origin = { 0, 0, 0 }
deformer:add_handle(foot):scale(params.scale, { about = origin })
    :rotate{ axis = similarity.rotate.axis, angle = params.turn, about = origin }
    :translate(table.unpack(similarity.translate))
deformer:solve()
local exact = figures.difference(cactus:copy():transform(similarity), whole)
print(string.format("a handle moved by the similarity: the rest off by %.1e of the size", exact))
figures.claim(exact < 1e-9, "the whole cactus follows a handle's similarity")

figures.write{
    name = "figure_3_3_similarity", out = params.out, view = "front", size = { 1200, 640 }, fit = "each",
    panels = { { cactus, "original" }, { mesh, "after a similarity of the foot" } },
}
