--- Pairs of well known models that go together: the kept part of each, and the matching directions. The
--- models
-- are not part of this library: give the folder that holds them.
--
--     local merge_pairs = require "merge_pairs"
--     local source, target, options = merge_pairs.load("mermaid", "models")
--     local mesh, report, parts = merging.join(source, target, options)
local lissom = require "lissom"

local merge_pairs = {}

local function both_ways(a, b)
    return { { a, b }, { { -a[1], -a[2], -a[3] }, { -b[1], -b[2], -b[3] } } }
end

local x, y, z = { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }
local back_z, down = { 0, 0, -1 }, { 0, -1, 0 }

-- file; levels of Loop subdivision first; cut.
local venus_waist = { "venus_torso_711.off", 2, { point = { 0, -0.95, 0 }, normal = y, seed = y } }
local venus_neck = { "venus_torso_711.off", 2,
    { point = { 0, 2.36, -0.1 }, normal = down, seed = { 0, 0, 0 } } }
local fish = { "fish_oded.obj", 2,
    { point = { 0, 0.1, -0.17 }, normal = { 0, 0.72, -0.7 }, seed = { 0, 0, -1.8 } } }
local mannequin = { "mannequin_nyugp.off", 0,
    { point = { 40, 0.5, -14.4 }, normal = { 0, 0.05, 1 }, seed = { 40, 0.7, -12 } } }
local camel = { "camel_isoblend.obj", 0,
    { point = { 0, 0.52, -0.6 }, normal = { 0, -0.76, 0.65 }, seed = { 0, 0.2, 0.5 } } }
local camel_head = { "camelhead.off", 0,
    { point = { 0, -0.28, 0.2 }, normal = y, seed = { 0, 0, -0.3 } } }
local cow = { "cow_3k.off", 1,
    { point = { 0.27, 0.1, 0 }, normal = { -1, -0.55, 0 }, seed = { -0.2, 0, 0 } } }
local dinosaur = { "dinosaur.obj", 0,
    { point = { 2, 3, 0 }, normal = { -0.5, 1, 0 }, seed = { -30, 40, 0 } } }
local dinosaur_back = { "dinosaur.obj", 0,
    { point = { 2, 3, 0 }, normal = { 0.5, -1, 0 }, seed = { 50, -40, 0 } } }
local feline = { "feline_small.obj", 1,
    { point = { -0.2, 1.42, -0.1 }, normal = { -1, 0, 0 }, seed = { -0.6, 1.4, -0.1 } } }
local feline_front = { "feline_small.obj", 1,
    { point = { -0.2, 1.42, -0.1 }, normal = x, seed = { 0.2, 1.4, -0.1 } } }
local spot = { "spot.obj", 1,
    { point = { 0, 0.17, -0.21 }, normal = { 0, -0.62, 0.79 }, seed = { 0, 0, 0.8 } } }
local cow_head, lion = { "cowhead.obj", 0 }, { "lion.off", 0 }

local cow_up, lion_up, back = { -0.5, 1, 0 }, { 0, -0.3, 1 }, { 1, 0.5, 0 }
local neck = both_ways(y, z)
table.insert(neck, { x, { -1, 0, 0 } })
table.insert(neck, { { -1, 0, 0 }, x })

local known = {
    mermaid = { fish, venus_waist, both_ways(y, back_z) },
    mannequin = { mannequin, venus_neck, neck },
    cow_on_camel = { cow_head, camel, both_ways(y, { 0, 0.65, 0.76 }) },
    camel_on_cow = { camel_head, cow, both_ways(back_z, cow_up) },
    lion_on_cow = { lion, cow, both_ways(lion_up, cow_up) },
    dinosaur_on_feline = { dinosaur, feline, both_ways(back, y) },
    feline_on_dinosaur = { feline_front, dinosaur_back, both_ways(y, back) },
    lion_on_spot = { lion, spot, both_ways(lion_up, y) },
}

--- The names of all pairs in order.
function merge_pairs.names()
    local names = {}
    for name in pairs(known) do table.insert(names, name) end
    table.sort(names)
    return names
end

-- A model of a folder, subdivided.
local function model(folder, part)
    local mesh = lissom.load(folder .. "/" .. part[1])
    return part[2] > 0 and mesh:subdivide(part[2], { scheme = "loop" }) or mesh
end

--- Source, target and the options of merging.join for a pair: their cuts, and keys.
function merge_pairs.load(name, folder)
    local pair = known[name]
    if not pair then
        lissom.error{ message = "no pair is called '" .. tostring(name) .. "'; there are: "
            .. table.concat(merge_pairs.names(), ", "), level = 2 }
    end
    local models = {}
    for i = 1, 2 do
        models[i] = model(folder, pair[i])
    end
    return models[1], models[2], { source_cut = pair[1][3], target_cut = pair[2][3], keys = pair[3] }
end

return merge_pairs
