-- A head merged to a body from two configurations (Figure 3.1): for any place, turn and size of the source,
-- the result is the same.
--
--     lissom run examples/merge/figure_3_1.lua
--     lissom run examples/merge/figure_3_1.lua --models ../shared/data/models --pair mannequin
--     lissom run examples/merge/figure_3_1.lua --source head.obj --target body.obj
--         --source_cut "0, 1, 0; 0, 1, 0" --target_cut "0, 2, 0; 0, -1, 0" --keys "z = z; -z = -z"

local figures = require "figures"
local merge_script = require "merge_script"
local merging = require "merging"
local transplant_head = require "recipes.transplant_head"

local params = merge_script.params(merging.schema)
local head, body, options = merge_script.models(params, merging.schema, function()
    local source, target, cuts = transplant_head.example()
    cuts.keys = "z = z; x = x; -z = -z; -x = -x"
    return source, target, cuts
end)

local mesh, report, parts = merging.join(head, body, options)
merge_script.finish(params, "figure_3_1", mesh, report, parts)
figures.claim(report.seam.after.max_dihedral < 20, "the seam is hidden")
figures.claim(#mesh:boundaries() == #parts.source:boundaries() + #parts.targets[1]:boundaries() - 2,
    "the two become one surface")

-- The cut parts, the source elsewhere; keys are vertices, so that they do not change.
local others, worst = {}, 0
for number = 1, 5 do
    local options_alone = { seam = options.seam, transition = options.transition }
    local difference, other = merging.configuration_error(mesh, parts, number, options_alone)
    others[number], worst = other, math.max(worst, difference)
end
print(string.format("from five other places, turns and sizes: the same to %.1e of the size", worst))
figures.claim(worst < 1e-9, "the result is the same in every configuration")

figures.write{
    name = "figure_3_1_configurations", out = params.out, fit = "each", columns = 4, size = { 1600, 420 },
    panels = { { parts.source, "source" }, { merging.elsewhere(parts.source, 1), "source elsewhere" },
        { mesh, "merged" }, { others[1], "merged from elsewhere" } },
}
