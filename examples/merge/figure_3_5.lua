-- One piece between four cylinders of different size (Figure 3.5): four joins at once, four targets, and a
-- piece with a hole in it. From any configuration the result is the same.
--
--     lissom run examples/merge/figure_3_5.lua
--     lissom run examples/merge/figure_3_5.lua --levels 1 --seam fair

local blocks = require "blocks"
local figures = require "figures"
local lissom = require "lissom"
local merge_script = require "merge_script"
local merging = require "merging"

local params = merge_script.params()

-- The piece is symmetrical; the cylinders are not.
local piece = blocks.valve{ levels = 3 + params.levels }
local targets, joins = {}, {}
local places = {
    { axis = "z", angle = -90, radius = 1.6, at = { 9, 0, 0 } },
    { axis = "x", angle = 90, radius = 0.5, at = { 0, 0, 8 } },
    { axis = "z", angle = 90, radius = 1.0, at = { -8, 0.6, 0 } },
    { axis = "x", angle = -90, radius = 0.7, at = { 0.5, 0, -7 } },
}
for i, place in ipairs(places) do
    local cylinder = lissom.shapes.cylinder{
        radius = place.radius, height = 5, segments = 32, rings = 24, caps = false,
    }
    cylinder:transform{ rotate = { axis = place.axis, angle = place.angle }, translate = place.at }
    targets[i] = cylinder
    -- Ends of the piece and of the cylinder that look at each other.
    local outward = { place.at[1], 0, place.at[3] }
    local from = merging.boundary_near(piece, outward)
    local to = merging.boundary_near(targets[i], { 0, 0, 0 })
    joins[i] = { source = from, target = to, keys = merging.keys(from, to, { { "y", "y" }, { "-y", "-y" } }) }
end

local options = { seam = params.seam }
local mesh, report, parts = merging.merge(joins, options)
merge_script.finish(params, "figure_3_5", mesh, report, parts, { seam = 1, wide = 5 })

figures.claim(mesh:genus() == 1 and mesh:components() == 1, "all become one surface of genus 1")
figures.claim(#mesh:boundaries() == 4, "the seams are closed")
for i, place in ipairs(places) do
    local ratio = report.joins[i].scale / report.joins[1].scale
    figures.claim(math.abs(ratio * places[1].radius / place.radius - 1) < 0.02,
        "each end takes its cylinder's size")
end
figures.claim(report.seam.after.max_dihedral < 20, "the seams are hidden")
local difference = merging.configuration_error(mesh, parts, 1, options)
print(string.format("from another place, turn and size: the same to %.1e of the size", difference))
figures.claim(difference < 1e-9, "the result is the same in every configuration")
