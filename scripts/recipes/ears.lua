--- A pair of ears, or horns, or wings: one part and its mirror image are put on two places of a head. Round
-- openings are cut there.
--
--     lissom run scripts/recipes/ears.lua --radius 0.8
--
--     local ears = require "recipes.ears"
--     local mesh, report, parts = ears.make(ear, head, { left = { 1, 2, 0 }, radius = 0.3 })
local lissom = require "lissom"
local merging = require "merging"

local ears = {}

--- Parameters, as lissom.params takes them.
ears.schema = {
    source_cut = { type = "string", default = "",
        help = "cut of the left ear: \"point; normal\" or \"point; normal; seed\", each x, y, z" },
    left = { type = "string", default = "", help = "x, y, z: place of the left ear on the head" },
    right = { type = "string", default = "", help = "and the right one; else its mirror image" },
    radius = { type = "number", default = 0, min = 0,
        help = "of the openings, along the surface; 0: a sixth of the head's size" },
    ear_front = { type = "string", default = "z", help = "the side of the ear that looks forward" },
    head_front = { type = "string", default = "z", help = "forward in the head's model" },
    mirror = { type = "choice", default = "x", choices = { "x", "y", "z" },
        help = "the axis along which left and right differ, in both models" },
}

local axis_number = { x = 1, y = 2, z = 3 }

local function mirrored(vector, axis)
    local copy = { vector[1], vector[2], vector[3] }
    copy[axis_number[axis]] = -copy[axis_number[axis]]
    return copy
end

-- The ear and its mirror image as one mesh, and the boundary of each.
local function both(ear, boundary, axis)
    local scale, point = { 1, 1, 1 }, boundary:points()[1]
    scale[axis_number[axis]] = -1
    local second = ear:copy():transform{ scale = scale }
    -- Side by side, so that the two don't touch; a merge does not depend on the place of its source.
    local apart = { 0, 0, 0 }
    apart[axis_number[axis]] = -(2 * math.abs(point[axis_number[axis]]) + 4 * ear:bounds().diagonal)
    second:transform{ translate = apart }
    local image = mirrored(point, axis)
    for k = 1, 3 do image[k] = image[k] + apart[k] end
    local pair = ear:copy():append(second)
    return pair, merging.boundary_near(pair, point), merging.boundary_near(pair, image)
end

-- The head with round openings about two points, and the boundary of each.
local function opened(head, left, right, radius)
    local function disc(point)
        return head:region{ geodesic = { from = head:nearest(point).vertex, radius = radius } }
    end
    local open, _, lines = merging.named("head", head.cut, head,
        { region = disc(left):union(disc(right)):invert() })
    return open, merging.boundary_near(open, left), merging.boundary_near(open, right), lines.report.warnings
end

-- The join of one ear: its front and back are keys.
local function join(from, to, ear_front, head_front, warnings)
    local none = { -ear_front[1], -ear_front[2], -ear_front[3] }
    local back = { -head_front[1], -head_front[2], -head_front[3] }
    return merging.joined(from, to, { { ear_front, head_front }, { none, back } }, warnings)
end

--- Merges an ear and its mirror image onto a head. `options` are values of the schema and options of
-- lissom.merge.
-- Returns the mesh, the report and the parts, as merging.merge.
function ears.make(ear, head, options)
    local values, own = merging.read_options("ears", ears.schema, options)
    if values.left == "" then
        lissom.error{ message = "'ears' needs the option 'left', a point on the head", level = 2 }
    end
    local left = merging.direction(values.left)
    local right = values.right ~= "" and merging.direction(values.right) or mirrored(left, values.mirror)
    local radius = values.radius > 0 and values.radius or head:size() / 6
    local part, boundary, of_ear = merging.named("ear", merging.part, ear,
        merging.read_cut(values.source_cut))
    local _, to_left, to_right, of_head = opened(head, left, right, radius)
    local _, from_left, from_right = both(part, boundary, values.mirror)
    local front, meets = merging.direction(values.ear_front), merging.direction(values.head_front)
    local warnings = merging.note(merging.note({}, "ear", of_ear), "head", of_head)
    return merging.merge({ join(from_left, to_left, front, meets, warnings),
        join(from_right, to_right, mirrored(front, values.mirror), meets, warnings) }, own, warnings)
end

--- A generated ear, a generated head, and options that join them.
function ears.example(levels)
    local blocks = require "blocks"
    local ear = blocks.surface{ levels = levels, open = { { 0, 0, 0, "-y" } },
        cells = blocks.cells{ { 0, 0, 0, 0, 1, 0 }, { 0, 2, 0, 1, 4, 0 }, { 0, 5, 0 } } }
    return ear:transform{ scale = { 1, 1, 0.6 }, translate = { 1, 0, 0 } },
        lissom.shapes.head{ vertices = 8000 }, { left = { 0.045, 0.125, 0 }, radius = 0.022 }
end

if ... ~= "recipes.ears" then
    local merge_script = require "merge_script"
    local params = merge_script.params(ears.schema)
    local ear, head, options = merge_script.models(params, ears.schema, ears.example)
    merge_script.finish(params, "ears", ears.make(ear, head, options))
end

return ears
