--- A feature on another model: a nose, an ear, a horn, a handle, or a part of a file or of another model.
--
--     lissom run scripts/recipes/put_feature.lua --part horn --mirror x
--     lissom run scripts/recipes/put_feature.lua --source head.obj --region "0, 0, .1; .05" --target cow.obj
--         --at "0, 1, 2" --clear
--
--     local put_feature = require "recipes.put_feature"
--     local mesh, report = put_feature.make(parts.make("nose"), face, { at = { 0, 0, 1 }, scale = 0.2 })
local lissom = require "lissom"
local merging = require "merging"
local parts = require "parts"
local vectors = require "vectors"

local put_feature = {}

--- Parameters, as lissom.params takes them.
put_feature.schema = {
    at = { type = "string", default = "", help = "x, y, z: place of the middle of the part on the target" },
    toward = { type = "string", default = "y", help = "the way on the target that is up for the part" },
    turn = { type = "number", default = 0, min = -360, max = 360, unit = "degrees",
        help = "turns the part on the surface, counter-clockwise seen from outside" },
    scale = { type = "number", default = 1, min = 1e-6, help = "size of the part on the target" },
    clear = { type = "boolean", default = false, help = "removes the old feature of the target there" },
    mirror = { type = "choice", default = "none", choices = { "none", "x", "y", "z" },
        help = "puts a mirror image on the other side as well, across this axis of the target's model" },
    normals = { type = "number", default = 0, min = 0, max = 1,
        help = "how much the boundary minds the surfaces' directions; .1 to .3 for parts that overhang" },
    lock = { type = "boolean", default = false, help = "keeps the size that `scale` says" },
}

local axis_number = { x = 1, y = 2, z = 3 }

local function mirrored(vector, axis)
    local copy = { vector[1], vector[2], vector[3] }
    copy[axis_number[axis]] = -copy[axis_number[axis]]
    return copy
end

-- The mirror image of a part, left and right of its `up` exchanged.
local function mirror_image(part)
    local side = vectors.cross(part.up, part.front)
    local k = 1
    for i = 2, 3 do
        if math.abs(side[i]) > math.abs(side[k]) then k = i end
    end
    local scale = { 1, 1, 1 }
    scale[k] = -1
    local mesh = part.mesh:copy():transform{ scale = scale }
    local function moved(region) return region and mesh:region{ vertices = region:vertices() } end
    return { mesh = mesh, region = moved(part.region), feature = moved(part.feature), up = part.up,
        front = part.front }
end

local function pasted(part, target, at, toward, values, turn)
    local paste = lissom.paste{ source = part.mesh, target = target, region = part.region,
        feature = part.feature, clear = values.clear, normals = values.normals,
        placement = { at = at, toward = toward, up = part.up, angle = turn, scale = values.scale } }
    paste:optimize()
    return paste:merge{ scale = values.lock and "lock" or nil }
end

--- The part of a model that is marked by "x, y, z; radius", a ball around its feature, as parts.make returns
-- one; up and front are its directions.
function put_feature.part_of(model, ball, up, front)
    local numbers = {}
    for word in ball:gmatch("[^;,%s]+") do table.insert(numbers, tonumber(word) or false) end
    if #numbers ~= 4 or not (numbers[1] and numbers[2] and numbers[3] and numbers[4]) then
        lissom.error{ message = "a region is \"x, y, z; radius\", not '" .. ball .. "'", level = 2 }
    end
    local center = { numbers[1], numbers[2], numbers[3] }
    return { mesh = model, region = model:region{ sphere = { center = center, radius = numbers[4] } },
        up = merging.direction(up or "y"), front = merging.direction(front or "z") }
end

--- Pastes a part, as parts.make or lissom.part.load return it, onto a target. `options` are values of the
-- schema, of which `at` is needed. Returns the mesh and a list of reports, one a paste.
function put_feature.make(part, target, options)
    local values, own = merging.read_options("put_feature", put_feature.schema, options)
    if next(own) then
        lissom.error{ message = "unknown option '" .. next(own) .. "' of 'put_feature'", level = 2 }
    end
    if values.at == "" then
        lissom.error{ message = "'put_feature' needs the option 'at', a point on the target", level = 2 }
    end
    local at, toward = merging.direction(values.at), merging.direction(values.toward)
    local mesh, report = pasted(part, target, at, toward, values, values.turn)
    local reports = { report }
    if values.mirror ~= "none" then
        local axis = values.mirror
        mesh, report = pasted(mirror_image(part), mesh, mirrored(at, axis), mirrored(toward, axis),
            values, -values.turn)
        table.insert(reports, report)
    end
    return mesh, reports
end

-- Places of the generated parts on the generated head.
local examples = {
    nose = { at = { 0, 0.02, 0.2 }, scale = 0.04, clear = true },
    ear = { at = { 0.08, 0.02, 0 }, scale = 0.035, mirror = "x" },
    horn = { at = { 0.045, 0.125, 0.02 }, toward = { 0, 0, -1 }, scale = 0.035, mirror = "x" },
    handle = { at = { 0, 0.13, 0 }, toward = "z", scale = 0.05 },
    spike = { at = { 0, 0.13, 0 }, scale = 0.035 },
    scale = { at = { 0, 0.1, 0.1 }, scale = 0.03 },
    leaf = { at = { 0, 0.13, 0 }, scale = 0.03 },
}

--- A generated part, a generated head of about so many vertices (8000), and options that join them.
function put_feature.example(name, vertices)
    local options = {}
    for key, value in pairs(examples[name]) do options[key] = value end
    return parts.make(name), lissom.shapes.head{ vertices = vertices or 8000 }, options
end

-- Returns the requested part and the model that it goes onto.
local function given(params)
    local part, target, options
    if params.source ~= "" then
        local model = params.region == "" and lissom.part.load(params.source)
            or put_feature.part_of(lissom.load(params.source), params.region, params.up, params.front)
        part, options = model, {}
    else
        part, target, options = put_feature.example(params.part)
    end
    if params.target ~= "" then target, options = lissom.load(params.target), {} end
    if not target then target = lissom.shapes.head{ vertices = 8000 } end
    return part, target, options
end

local script_schema = {
    part = { type = "choice", default = "horn", choices = parts.names, help = "a generated part" },
    source = { type = "file", default = "", help = "a part file, or a model with the feature, instead" },
    region = { type = "string", default = "",
        help = "\"x, y, z; radius\": a ball around the feature of the model" },
    up = { type = "string", default = "y", help = "the way that is up on the feature of the model" },
    front = { type = "string", default = "z", help = "the way that it looks" },
    save_part = { type = "string", default = "", help = "keeps the part in a .glb file, too" },
    target = { type = "file", default = "",
        help = "the model that it goes onto, instead of a generated head" },
    out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
    size = { type = "integer", default = 640, min = 64, max = 4096, unit = "pixels", help = "of a picture" },
}

local function finish(params, mesh, reports)
    local merge_pictures = require "merge_pictures"
    for i, report in ipairs(reports) do
        local p = report.paste
        print(string.format("paste %d: scale %.3g, boundary of %d vertices, misfit %.3f, near it %.4f; %s", i,
            p.scale, p.search.loop_size, p.search.misfit[#p.search.misfit], p.near.energy, report.verdict))
    end
    local file = params.out .. "/put_feature"
    print(mesh:save(file .. ".obj"))
    local clay = mesh:copy()
    clay:remove_attribute("color")
    local last = reports[#reports]
    print(lissom.render{ meshes = { merge_pictures.colored(mesh, last), clay }, columns = 2,
        size = { 2 * params.size, params.size }, file = file .. ".png" })
    local camera = merge_pictures.seam_camera(last, { wide = 6 })
    print(lissom.render{ mesh = clay, camera = camera, size = { params.size, params.size },
        file = file .. "_seam.png" })
end

if ... ~= "recipes.put_feature" then
    local all = {}
    for _, list in ipairs{ script_schema, put_feature.schema } do
        for name, one in pairs(list) do all[name] = one end
    end
    local params = lissom.params(all)
    local part, target, options = given(params)
    for name, one in pairs(put_feature.schema) do
        if params[name] ~= one.default then options[name] = params[name] end
    end
    if params.save_part ~= "" then
        lissom.part.save(params.save_part, { mesh = part.mesh, region = part.region,
            feature = part.feature, up = part.up, front = part.front })
    end
    finish(params, put_feature.make(part, target, options))
end

return put_feature
