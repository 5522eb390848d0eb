--- A tail, or any other part with one opening, in the place of the cut part of a body: a mermaid.
--
--     lissom run scripts/recipes/add_tail.lua --twist 20
--     lissom run scripts/recipes/add_tail.lua --models ../shared/data/models --pair mermaid
--
--     local add_tail = require "recipes.add_tail"
--     local mesh, report, parts = add_tail.make(fish, torso, { source_cut = "0, .1, -.2; 0, .7, -.7" })
local merging = require "merging"
local vectors = require "vectors"

local add_tail = {}

--- Parameters, as lissom.params takes them.
add_tail.schema = {
    source_cut = { type = "string", default = "",
        help = "cut of the tail: \"point; normal\" or \"point; normal; seed\", each x, y, z" },
    target_cut = { type = "string", default = "", help = "cut of the body" },
    tail_up = { type = "string", default = "y", help = "the side of the tail that meets `body_up`" },
    body_up = { type = "string", default = "-z", help = "the side of the body that meets `tail_up`" },
    twist = { type = "number", default = 0, min = -180, max = 180, unit = "degrees",
        help = "turns the tail about its joint" },
}

--- Merges a tail onto a body. `options` are values of the schema and options of lissom.merge. Returns
-- the mesh, the report and the parts, as merging.merge.
function add_tail.make(tail, body, options)
    local values, own = merging.read_options("add_tail", add_tail.schema, options)
    local _, from, found = merging.named("tail", merging.part, tail, merging.read_cut(values.source_cut))
    local _, to, seen = merging.named("body", merging.part, body, merging.read_cut(values.target_cut))
    local none = { 0, 0, 0 }
    local up = merging.direction(values.tail_up)
    local meets = merging.turned(values.body_up, merging.axis(to), values.twist)
    local directions = { { up, meets }, { vectors.plus(none, up, -1), vectors.plus(none, meets, -1) } }
    local warnings = merging.note(merging.note({}, "tail", found), "body", seen)
    return merging.merge({ merging.joined(from, to, directions, warnings) }, own, warnings)
end

--- A generated tail, a generated torso, and options that join them.
function add_tail.example(levels)
    local blocks = require "blocks"
    return blocks.tail{ levels = levels },
        blocks.torso{ levels = levels, waist = "open", neck = "closed" }, {}
end

if ... ~= "recipes.add_tail" then
    local merge_script = require "merge_script"
    local params = merge_script.params(add_tail.schema)
    local tail, body, options = merge_script.models(params, add_tail.schema, add_tail.example)
    options.keys = nil
    merge_script.finish(params, "add_tail", add_tail.make(tail, body, options))
end

return add_tail
