--- Another limb, or the same one several times, in the place of limbs that are cut off.
--
--     lissom run scripts/recipes/replace_limb.lua
--
--     local replace_limb = require "recipes.replace_limb"
--     local mesh, report, parts = replace_limb.make(arm, body, {
--         places = { { point = { 1, 2, 0 }, normal = { -1, 0, 0 } },
--             { point = { -1, 2, 0 }, normal = { 1, 0, 0 }, mirror = "x" } },
--         keys = { { "y", "y" }, { "-y", "-y" } },
--     })
local lissom = require "lissom"
local merging = require "merging"

local replace_limb = {}

--- Parameters, as lissom.params takes them. In Lua there may be `places` instead of `target_cut`: a list of
-- cuts of the body, each with `mirror` ("x", "y" or "z") for the limb's mirror image along that axis.
replace_limb.schema = {
    source_cut = { type = "string", default = "",
        help = "cut of the limb: \"point; normal\" or \"point; normal; seed\", each x, y, z" },
    target_cut = { type = "string", default = "", help = "cut that removes the limb of the body" },
    keys = { type = "string", default = "",
        help = "pairs that meet: \"y = -z; ...\", directions on limb and body; else the best fit" },
}

local axis_number = { x = 1, y = 2, z = 3 }

local function mirrored(vector, axis)
    local copy = { vector[1], vector[2], vector[3] }
    if axis then copy[axis_number[axis]] = -copy[axis_number[axis]] end
    return copy
end

local function without_mirror(place)
    local cut = {}
    for key, value in pairs(place) do cut[key] = key ~= "mirror" and value or nil end
    return cut
end

-- Returns the body after all cuts, and for each a point of its boundary. Adds the warnings of the cuts to a
-- list.
local function cut_all(body, places, warnings)
    local points = {}
    for i, place in ipairs(places) do
        local name = "place " .. i
        local kept, boundary, found = merging.named(name, merging.part, body, without_mirror(place))
        merging.note(warnings, name, found)
        body, points[i] = kept, boundary:points()[1]
    end
    return body, points
end

-- Returns copies of the limb, one for each place, mirrored if asked for, side by side in one mesh, and for
-- each a point of its boundary.
local function copies(limb, boundary, places)
    local all, points, point = nil, {}, boundary:points()[1]
    local step = 3 * limb:bounds().diagonal
    for i, place in ipairs(places) do
        local scale = { 1, 1, 1 }
        if place.mirror then scale[axis_number[place.mirror]] = -1 end
        local image, center = mirrored(point, place.mirror), mirrored(limb:bounds().center, place.mirror)
        local apart = { i * step - center[1], -center[2], -center[3] }
        local copy = limb:copy():transform{ scale = scale, translate = apart }
        points[i] = { image[1] + apart[1], image[2] + apart[2], image[3] + apart[3] }
        all = all and all:append(copy) or copy
    end
    return all, points
end

--- Merges copies of a limb onto a body. `options` are values of the schema, `places`, and options of
-- lissom.merge. Keys are directions of the limb as it is given. Returns
-- the mesh, the report and the parts, as merging.merge.
function replace_limb.make(limb, body, options)
    local given = {}
    for key, value in pairs(options or {}) do given[key] = key ~= "places" and value or nil end
    local values, own = merging.read_options("replace_limb", replace_limb.schema, given)
    local places = options and options.places or { merging.read_cut(values.target_cut) }
    if #places == 0 then
        lissom.error{ level = 2,
            message = "'replace_limb' needs 'target_cut' or 'places': the cuts that remove limbs" }
    end
    local part, boundary, found = merging.named("limb", merging.part, limb,
        merging.read_cut(values.source_cut))
    local warnings = merging.note({}, "limb", found)
    local target, there = cut_all(body, places, warnings)
    local source, here = copies(part, boundary, places)

    local joins, directions = {}, merging.read_keys(values.keys)
    for i, place in ipairs(places) do
        local from, to = merging.boundary_near(source, here[i]), merging.boundary_near(target, there[i])
        local turned = directions and {}
        for k, pair in ipairs(directions or {}) do
            turned[k] = { mirrored(merging.direction(pair[1]), place.mirror), pair[2] }
        end
        joins[i] = merging.joined(from, to, turned, warnings)
    end
    return merging.merge(joins, own, warnings)
end

--- Arms of a cactus for a generated body on four legs.
function replace_limb.example(levels)
    local blocks = require "blocks"
    local limb = blocks.surface{ levels = levels, open = { { 0, 4, 0, "y" } },
        cells = blocks.cells{ { 0, 0, 0, 0, 4, 0 }, { 0, 0, 1, 0, 0, 2 }, { 1, 0, 0, 2, 0, 0 }, { -1, 0, -1 },
            { 0, 0, -1 } } }
    local places = {}
    for _, x in ipairs{ -1, 1 } do
        places[#places + 1] = { point = { x, 2, 2.5 }, normal = { 0, 1, 0 }, mirror = x < 0 and "x" or nil }
    end
    return limb, blocks.beast{ levels = levels, open = false },
        { places = places, keys = { { "z", "z" }, { "-z", "-z" } } }
end

if ... ~= "recipes.replace_limb" then
    local merge_script = require "merge_script"
    local params = merge_script.params(replace_limb.schema)
    local limb, body, options = merge_script.models(params, replace_limb.schema, replace_limb.example)
    merge_script.finish(params, "replace_limb", replace_limb.make(limb, body, options))
end

return replace_limb
