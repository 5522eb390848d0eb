-- A transition region (Figure 3.7): within a band on either side of the seam, details of both parts fade
-- into each other. Beside it the thesis's, to the letter: its regions overlap, so that the source begins
-- where the target's region ends and the whole is shorter by it; the source's connectivity is kept there.
--
--     lissom run examples/merge/figure_3_7.lua --width 1.5
--     lissom run examples/merge/figure_3_7.lua --models ../shared/data/models --pair dinosaur_on_feline

local blocks = require "blocks"
local figures = require "figures"
local merge_pictures = require "merge_pictures"
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

local plain, plain_report, parts = merging.join(source, target, options)
merge_script.finish(params, "figure_3_7_plain", plain, plain_report, parts)

local function band(boundary) return params.width * boundary:length() / (2 * math.pi) end
options.transition = { source = band(parts.joins[1].source), target = band(parts.joins[1].target) }
local mesh, report, faded = merging.join(source, target, options)
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
figures.claim(report.seam.after.max_dihedral < math.max(20, plain_report.seam.after.max_dihedral),
    "the seam is hidden")

-- The thesis's. If the far end of the target's region is too jagged for its band of new faces, the seam is
-- sewn as by default.
local letter = {}
for name, value in pairs(options) do letter[name] = value end
letter.fidelity, letter.seam = "thesis", "band"
local literal, literal_report = merging.join(source, target, letter)
if not literal then
    print("the thesis's seam: " .. literal_report)
    letter.seam = "conform"
    literal, literal_report = merging.join(source, target, letter)
end
print(string.format("to the letter: %.2f degrees, %d of %d vertices without a counterpart",
    bends(literal, literal_report), literal_report.transition[1].source.unmapped,
    literal_report.transition[1].source.vertices))
local function across(one) return one.seam.after.max_dihedral end
print(string.format("greatest angle across the seam: %.1f degrees without, %.1f with a transition, "
    .. "%.1f to the letter", across(plain_report), across(report), across(literal_report)))
figures.claim(#literal:boundaries() == #plain:boundaries() and literal:genus() == plain:genus(),
    "the thesis's seam is closed")
figures.claim(#literal_report.target < #report.target, "the thesis's regions overlap")

-- The parts with their regions in the colours of the merged sides.
local function with_region(boundary, width)
    local copy = boundary:mesh():copy()
    copy:remove_attribute("color")
    local region = copy:region{ geodesic = { from = boundary:vertices(), radius = width } }
    local colors = copy:add_attribute{ name = "color", domain = "vertex", width = 4 }
    for v = 1, #copy do
        local color = region:contains(v) and merge_pictures.sand or { 0.8, 0.8, 0.8, 1 }
        for k = 1, 4 do colors[4 * v - 4 + k] = color[k] end
    end
    return copy
end

local joined = parts.joins[1]
figures.write{
    name = "figure_3_7_compared", out = params.out, size = { 1800, 1000 }, columns = 3, fit = "each",
    panels = { { with_region(joined.source, options.transition.source), "source and its region" },
        { with_region(joined.target, options.transition.target), "target and its region" },
        { plain, "merged without" }, { mesh, "with a transition" },
        { literal, "to the letter: regions overlap" },
        { merge_pictures.colored(literal, literal_report), "which side each comes from" } },
}
