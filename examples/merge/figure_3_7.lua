-- A transition region (Figure 3.7): within a band on either side of the seam, details of both parts fade
-- into each other.
--
--     lissom run examples/merge/figure_3_7.lua --width 1.5
--     lissom run examples/merge/figure_3_7.lua --models ../shared/data/models --pair dinosaur_on_feline

local blocks = require "blocks"
local figures = require "figures"
local merge_script = require "merge_script"
local merging = require "merging"
local transplant_head = require "recipes.transplant_head"

local schema = { width = { type = "number", default = 0.9, min = 0.1, max = 5,
    help = "of the band on each side, in radii of the boundary" } }
for name, one in pairs(merging.schema) do schema[name] = one end
local params = merge_script.params(schema)

local source, target, options = merge_script.models(params, merging.schema, function()
    local head, _, cuts = transplant_head.example()
    local body = blocks.torso{ levels = 4 }
    cuts.keys = "z = z; x = x; -z = -z; -x = -x"
    return head, body, cuts
end)

local plain, plain_report, parts = assert(merging.join(source, target, options))
merge_script.finish(params, "figure_3_7_plain", plain, plain_report, parts)

local function band(boundary) return params.width * boundary:length() / (2 * math.pi) end
options.transition = { source = band(parts.joins[1].source), target = band(parts.joins[1].target) }
local mesh, report, faded = assert(merging.join(source, target, options))
merge_script.finish(params, "figure_3_7", mesh, report, faded)

-- How much faces turn against each other within the bands.
local function bends(merged, merged_report)
    local near = merged_report.seams[1]:region():grow(8)
    local part = merged:extract(near)
    return (figures.roughness(part))
end
print(string.format("mean angle between faces within eight edges of the seam: %.2f degrees, %.2f without",
    bends(mesh, report), bends(plain, plain_report)))
figures.claim(#mesh:boundaries() == #plain:boundaries() and mesh:genus() == plain:genus(),
    "the seam is closed")
figures.claim(report.transition_kept > 0.9, "the transition is made")
figures.claim(report.seam.after.greatest_dihedral < math.max(20, plain_report.seam.after.greatest_dihedral),
    "the seam is hidden")

figures.write{
    name = "figure_3_7_compared", out = params.out, size = { 1400, 640 },
    panels = { { parts.source, "source" }, { parts.targets[1], "target" },
        { plain, "merged" }, { mesh, "with a transition" } }, fit = "each",
}
