-- The hind part of a beast on the front of another (Figure 3.6). In the free configuration its size follows
-- from their boundaries, and its legs may be too short. In the fixed one it is put in its place by hand, the
-- feet are held in place, and the legs reach the ground.
--
--     lissom run examples/merge/figure_3_6.lua --source_legs 3
--     lissom run examples/merge/figure_3_6.lua --models ../shared/data/models
--         --pair dinosaur_on_feline --tilt 45
--
-- For other models the source is put before the target's opening, tilted, and the half of it that is farthest
-- away is held.

local blocks = require "blocks"
local figures = require "figures"
local merge_script = require "merge_script"
local merging = require "merging"
local vectors = require "vectors"

local schema = {
    source_legs = { type = "integer", default = 2, min = 1, max = 6, help = "length of the hind legs" },
    target_legs = { type = "integer", default = 4, min = 1, max = 6, help = "length of the front legs" },
    tilt = { type = "number", default = 0, min = -120, max = 120, unit = "degrees",
        help = "how far a given model is turned about `tilt_axis`, in its place" },
    tilt_axis = { type = "string", default = "z", help = "a direction of the target's model" },
    hold = { type = "number", default = 0.5, min = 0.05, max = 0.9,
        help = "share of the height over the opening that is held, of a given model" },
}
for name, one in pairs(merging.schema) do schema[name] = one end
local params = merge_script.params(schema)

local given = params.pair ~= "" or params.source ~= ""
local source, target, options = merge_script.models(params, merging.schema, function()
    local middle = { 0, 100, 0 }
    return blocks.beast{ legs = params.source_legs, open = false },
        blocks.beast{ legs = params.target_legs, open = false },
        { source_cut = { point = middle, normal = { 0, 0, -1 } },
            target_cut = { point = middle, normal = "z" },
            keys = "1, 1, 0 = 1, 1, 0; -1, 1, 0 = -1, 1, 0; -1, -1, 0 = -1, -1, 0; 1, -1, 0 = 1, -1, 0" }
end)
local back, from = merging.part(source, merging.read_cut(options.source_cut))
local front, to = merging.part(target, merging.read_cut(options.target_cut))
local directions = merging.read_keys(options.keys) or { { "y", "y" } }

-- Feet of the generated beasts stand on y = 0.
local function feet(mesh)
    return mesh:region{ plane = { point = { 0, 0.8, 0 }, normal = { 0, -1, 0 } } }
end

-- Returns the part far from the opening of a given model.
local function far_half(mesh, boundary)
    local axis, center, most = merging.axis(boundary), merging.center(boundary), 0
    local function height(...) return -vectors.dot(vectors.plus({ ... }, center, -1), axis) end
    for v = 1, #mesh do most = math.max(most, height(mesh:position(v))) end
    local clear = boundary:region():grow(3)
    local far = mesh:region{ where = function(_, ...) return height(...) > (1 - params.hold) * most end }
    return far:minus(clear)
end

local placed, there, held
if given then
    placed, there = merging.placed(from, to, directions[1])
    placed:transform{ rotate = { axis = merging.direction(params.tilt_axis), angle = params.tilt,
        about = merging.center(there) } }
    held = far_half(placed, there)
else
    placed, there = back, from
    held = feet(placed)
end

local function merged(boundary, more)
    local all = { seam = options.seam, transition = options.transition }
    for key, value in pairs(more) do all[key] = value end
    return merging.merge({ { source = boundary, target = to,
        keys = merging.keys(from, to, directions) } }, all)
end
local free, free_report, free_parts = merged(from, {})
local fixed, fixed_report, fixed_parts = merged(there, { configuration = "fixed", fixed = { held } })
local view = given and {} or { view = "left" }
merge_script.finish(params, "figure_3_6_free", free, free_report, free_parts, view)
merge_script.finish(params, "figure_3_6_fixed", fixed, fixed_report, fixed_parts, view)

-- Held vertices by their numbers in the source, in the merged mesh.
local function max_move(mesh, report)
    local worst = 0
    for v = #mesh - #placed + 1, #mesh do
        local origin = v > 0 and report.provenance:vertex(v) or {}
        if #origin == 1 and origin[1].side == "source" and held:contains(origin[1].vertex) then
            local p, q = { mesh:position(v) }, { placed:position(origin[1].vertex) }
            worst = math.max(worst, vectors.length(vectors.plus(p, q, -1)))
        end
    end
    return worst
end
print(string.format("the held part moves by %g if it is fixed, by %.3g if all is free",
    max_move(fixed, fixed_report), max_move(free, free_report)))
figures.claim(#held > 0, "something is held")
figures.claim(max_move(fixed, fixed_report) == 0, "the fixed part stays to the bit")
figures.claim(given or max_move(free, free_report) > 0.5, "the free configuration moves the feet")
figures.claim(#fixed:boundaries() == #back:boundaries() + #front:boundaries() - 2, "the seam is closed")
local limit = given and 30 or 20
figures.claim(fixed_report.seam.after.max_dihedral < limit and free_report.seam.after.max_dihedral
    < limit, "the seams are hidden")

figures.write{
    name = "figure_3_6", out = params.out, view = view.view, size = { 1500, 500 },
    fit = given and "each" or "all",
    panels = { { placed, "source, in its place" }, { free, "free" }, { fixed, "fixed" } },
}
