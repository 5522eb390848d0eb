--- A head on another body: both are cut through the neck, and the head takes the place, the direction and
-- the size that the body's neck gives it.
--
--     lissom run scripts/recipes/transplant_head.lua --turn 40
--     lissom run scripts/recipes/transplant_head.lua --source head.obj --target body.obj
--         --source_cut "0, 1, 0; 0, 1, 0" --target_cut "0, 2, 0; 0, -1, 0"
--
--     local transplant_head = require "recipes.transplant_head"
--     local mesh, report, parts = transplant_head.make(head, body, { head_front = "-y", turn = 20 })
local merging = require "merging"
local vectors = require "vectors"

local transplant_head = {}

--- Parameters, as lissom.params takes them.
transplant_head.schema = {
    source_cut = { type = "string", default = "",
        help = "cut of the head: \"point; normal\" or \"point; normal; seed\", each x, y, z" },
    target_cut = { type = "string", default = "", help = "cut of the body" },
    head_up = { type = "string", default = "y", help = "upwards in the head's model" },
    head_front = { type = "string", default = "z", help = "direction of its face" },
    body_up = { type = "string", default = "y", help = "along the body's neck, away from the body" },
    body_front = { type = "string", default = "z", help = "the side of the body's neck under the chin" },
    turn = { type = "number", default = 0, min = -180, max = 180, unit = "degrees",
        help = "how far the head looks to its left" },
}

-- Front, left, back and right of a neck.
local function around(up, front, turn)
    front = merging.turned(front, up, turn)
    local left = vectors.cross(merging.direction(up), front)
    local none = { 0, 0, 0 }
    return { front, left, vectors.plus(none, front, -1), vectors.plus(none, left, -1) }
end

--- Merges a head onto a body. `options` are values of the schema and options of lissom.merge. Returns
-- the mesh, the report and the parts, as merging.join.
function transplant_head.make(head, body, options)
    local values, own = merging.read_options("transplant_head", transplant_head.schema, options)
    own.source_cut, own.target_cut, own.keys = values.source_cut, values.target_cut, {}
    local from = around(values.head_up, values.head_front, 0)
    local to = around(values.body_up, values.body_front, values.turn)
    for i = 1, 4 do own.keys[i] = { from[i], to[i] } end
    return merging.join(head, body, own)
end

--- A generated head, a generated torso, and options that join them.
function transplant_head.example(levels)
    local blocks, lissom = require "blocks", require "lissom"
    return lissom.shapes.head{ vertices = levels == 2 and 4000 or 10000 }, blocks.torso{ levels = levels }, {
        source_cut = { point = { 0, -0.15, 0 }, normal = { 0, 1, -0.25 }, seed = { 0, 0.1, 0 } } }
end

if ... ~= "recipes.transplant_head" then
    local merge_script = require "merge_script"
    local params = merge_script.params(transplant_head.schema)
    local head, body, options = merge_script.models(params, transplant_head.schema, transplant_head.example)
    merge_script.finish(params, "transplant_head", transplant_head.make(head, body, options))
end

return transplant_head
