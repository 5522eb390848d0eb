--- Parts on top of each other: each takes its size from the opening of the one below.
--
--     lissom run scripts/recipes/stack.lua --parts 4
--
--     local stack = require "recipes.stack"
--     local mesh, reports = stack.make({ foot, trunk, trunk, crown }, { axis = "y", low = 0.1, high = 0.1 })
local lissom = require "lissom"
local merging = require "merging"
local vectors = require "vectors"

local stack = {}

--- Parameters, as lissom.params takes them.
stack.schema = {
    axis = { type = "string", default = "y", help = "upwards, in all parts" },
    front = { type = "string", default = "z", help = "the sides that come to lie above each other" },
    low = { type = "number", default = 0.1, min = 0, max = 0.45,
        help = "share of a part's height that is cut off below, if it is closed there" },
    high = { type = "number", default = 0.1, min = 0, max = 0.45, help = "the same above" },
    turn = { type = "number", default = 0, min = -180, max = 180, unit = "degrees",
        help = "how far each part is turned on the one below" },
}

-- Lowest and highest point of a mesh along a direction, as numbers.
local function extent(mesh, axis)
    local low, high, positions = math.huge, -math.huge, mesh:positions()
    for i = 1, #positions, 3 do
        local d = vectors.dot(axis, { positions[i], positions[i + 1], positions[i + 2] })
        low, high = math.min(low, d), math.max(high, d)
    end
    return low, high
end

-- The boundary that lies highest along a direction, if it looks that way.
local function highest(mesh, axis)
    local best, most
    for _, boundary in ipairs(mesh:boundaries()) do
        local height = vectors.dot(axis, merging.center(boundary))
        local along = math.abs(vectors.dot(merging.axis(boundary), axis))
        if along > 0.5 and (not most or height > most) then best, most = boundary, height end
    end
    return best, most
end

-- The mesh with an opening at its end along a direction, and that boundary: one that lies in the last
-- `share` of its height, or a new one.
local function opened(mesh, axis, share)
    local low, high = extent(mesh, axis)
    local boundary, height = highest(mesh, axis)
    local level = high - share * (high - low)
    if boundary and height >= level - 0.05 * (high - low) then return mesh, boundary, {} end
    local best, far = nil, -math.huge
    for v = 1, #mesh do
        local p = { mesh:position(v) }
        local d = vectors.dot(axis, p)
        if d > far then best, far = p, d end
    end
    local none = { 0, 0, 0 }
    return merging.part(mesh, { point = vectors.plus(best, axis, level - far),
        normal = vectors.plus(none, axis, -1) })
end

--- Stacks a list of parts on the first. `options` are values of the schema and options of lissom.merge.
-- Returns the mesh, the report of the last merge and its parts (with the warnings of all cuts), and the list
-- of all reports.
function stack.make(list, options)
    local values, own = merging.read_options("stack", stack.schema, options)
    if #list < 2 then lissom.error{ message = "'stack' needs a list of two or more parts", level = 2 } end
    local axis = vectors.unit(merging.direction(values.axis))
    local down = vectors.plus({ 0, 0, 0 }, axis, -1)
    local front = merging.direction(values.front)
    local back = vectors.plus({ 0, 0, 0 }, front, -1)
    local directions = { { front, merging.turned(front, axis, values.turn) },
        { back, merging.turned(back, axis, values.turn) } }
    local mesh, reports, warnings, parts = list[1], {}, {}, nil
    for i = 2, #list do
        local last, name = "part " .. (i - 1), "part " .. i
        local _, to, below = merging.named(last, opened, mesh, axis, values.high)
        local _, from, above = merging.named(name, opened, list[i], down, values.low)
        merging.note(merging.note(warnings, last, below), name, above)
        local report
        local join = merging.joined(from, to, directions, warnings)
        mesh, report, parts = merging.named(name, merging.merge, { join }, own, warnings)
        reports[i - 1] = report
    end
    return mesh, reports[#reports], parts, reports
end

--- Generated parts: a foot, bellies, and a head.
function stack.example(levels, count)
    local blocks = require "blocks"
    local list = { blocks.torso{ levels = levels } }
    for i = 2, (count or 4) - 1 do
        list[i] = lissom.shapes.sphere{ segments = 4 * 2 ^ ((levels or 3) - 1) }
            :transform{ scale = { 1, 0.8, 1 } }
    end
    table.insert(list, lissom.shapes.head{ vertices = 8000 })
    return list, { low = 0.12, high = 0.12 }
end

if ... ~= "recipes.stack" then
    local merge_script = require "merge_script"
    local schema = { parts = { type = "integer", default = 4, min = 2, max = 12, help = "how many parts" } }
    for name, one in pairs(stack.schema) do schema[name] = one end
    local params = merge_script.params(schema)
    local list, options = stack.example(3, params.parts)
    for name in pairs(stack.schema) do options[name] = params[name] end
    local mesh, report, parts = stack.make(list, options)
    merge_script.finish(params, "stack", mesh, report, parts)
end

return stack
