-- Scripts in a page have, beside the library: the modules of scripts/, and lissom.render, whose pictures
-- the page draws. `playground.shown(...)` returns the pictures and the results of a run, as tables of
-- objects.
local lissom = require "lissom"

package.path = "./?.lua;/lissom/scripts/?.lua;/lissom/?.lua"

local playground = { pictures = {}, finished = {} }

local function kind_of(value)
    -- Objects of the library show the name of their kind in place of a metatable.
    local name = type(value) == "userdata" and getmetatable(value)
    return type(name) == "string" and name or type(value)
end

-- A list of a value that may be one or a list.
local function listed(value)
    if value == nil then return {} end
    if type(value) == "table" then return value end
    return { value }
end

local function camera_table(camera)
    if camera == nil then return nil end
    return { eye = camera:eye(), target = camera:target(), up = camera:up(), fov = camera:fov() }
end

-- The named regions that are shown, of all meshes, in the order of their colours.
local function region_names(options, meshes)
    local wanted = type(options.regions) == "table" and options.regions or nil
    local seen, names = {}, {}
    for _, mesh in ipairs(options.regions and meshes or {}) do
        for _, name in ipairs(mesh:regions()) do seen[name] = true end
    end
    for _, name in ipairs(wanted or {}) do seen[name] = seen[name] and "wanted" end
    for name, mark in pairs(seen) do
        if not wanted or mark == "wanted" then names[#names + 1] = name end
    end
    table.sort(names)
    return names
end

-- Parts of a mesh in colours, small ones over large ones; names are told.
local function parts_of(options, mesh, names)
    local parts = {}
    for i, name in ipairs(names) do
        local region = lissom.try(mesh.region, mesh, name)
        if region then parts[#parts + 1] = { region = region, color = i, name = name } end
    end
    table.sort(parts, function(a, b)
        if #a.region == #b.region then return a.name < b.name end
        return #a.region > #b.region
    end)
    local function add(region, color)
        if type(region) == "string" then region = lissom.try(mesh.region, mesh, region) end
        if region then parts[#parts + 1] = { region = region, color = color } end
    end
    if options.region ~= nil then add(options.region, "region") end
    for _, handle in ipairs(listed(options.handles)) do add(handle, "handle") end
    return parts
end

local function scalars_of(options)
    local scalars = options.scalars
    if kind_of(scalars) == "lissom.Buffer" then return { buffer = scalars } end
    if type(scalars) == "table" then return { numbers = scalars } end
    if type(scalars) == "string" then return { name = scalars } end
    return nil
end

-- Meshes and strands are copied: the script may go on to change them.
local function drawn_meshes(options, meshes)
    local drawn, names = {}, region_names(options, meshes)
    for i, mesh in ipairs(meshes) do
        local color = type(options.color) == "table" and options.color[i] or options.color
        if type(color) == "table" then color = nil end
        local copy = mesh:copy()
        drawn[i] = {
            mesh = copy, color = color, offset = options.offsets and options.offsets[i],
            parts = parts_of(options, copy, names), scalars = scalars_of(options),
            caption = options.captions and options.captions[i],
        }
    end
    return drawn
end

local function look_of(hair)
    local look = {}
    for _, key in ipairs{ "color", "unit", "primary", "primary_exponent", "secondary", "secondary_exponent",
        "shadow", "root_tone", "tip_tone" } do
        look[key] = hair and hair[key]
    end
    return look
end

local function lines_of(options)
    local lines = {}
    for _, path in ipairs(options.paths or {}) do
        lines[#lines + 1] = path:points()
    end
    return lines
end

local function picture_of(options)
    local meshes = options.meshes or listed(options.mesh)
    local strands = {}
    for _, one in ipairs(listed(options.strands)) do strands[#strands + 1] = one:copy() end
    if options.style and #meshes == 0 and #strands == 0 then meshes = { options.style:head() } end
    return {
        name = tostring(options.file or "picture"):match("([^/]+)$"):gsub("%.png$", ""),
        meshes = drawn_meshes(options, meshes), strands = strands, hair = look_of(options.hair),
        wire = options.wire, flat = options.shading == "flat", crease = options.crease,
        boundaries = options.boundaries, columns = options.columns, fit = options.fit, view = options.view,
        up = options.up, camera = camera_table(options.camera), range = options.range,
        vertex_colors = options.vertex_colors, lines = lines_of(options), points = options.points,
        styles = listed(options.style),
    }
end

-- ---- Results of a script

local add_value

local function add_scene(picture, scene)
    for _, name in ipairs(scene:names()) do
        local entry = scene:info(name)
        if entry.visible ~= false then
            add_value(picture, scene:get(name), entry.style or {}, entry.transform)
        end
    end
end

-- The points of a polyline, with the first one again at the end of a closed one.
local function corners_of(line)
    local numbers, points = line:points(), {}
    if type(numbers[1]) == "table" then
        for i, point in ipairs(numbers) do points[i] = point end
    else
        for i = 1, #numbers, 3 do
            points[#points + 1] = { numbers[i], numbers[i + 1], numbers[i + 2] }
        end
    end
    if line:is_closed() and #points > 2 then points[#points + 1] = points[1] end
    return points
end

local adders = {
    ["lissom.Mesh"] = function(picture, mesh, style, transform)
        local color = type(style.color) == "string" and style.color or nil
        table.insert(picture.meshes, { mesh = mesh, color = color, parts = {}, transform = transform })
    end,
    ["lissom.Strands"] = function(picture, strands) picture.strands[#picture.strands + 1] = strands end,
    ["lissom.Scene"] = function(picture, scene)
        picture.scene = picture.scene or scene
        add_scene(picture, scene)
    end,
    ["lissom.Deformer"] = function(picture, deformer, style, transform)
        add_value(picture, deformer:mesh(), style, transform)
    end,
    ["lissom.Hairstyle"] = function(picture, style, _, transform)
        table.insert(picture.styles, style)
        add_value(picture, style:head(), nil, transform)
    end,
    ["lissom.Path"] = function(picture, path) picture.lines[#picture.lines + 1] = path:points() end,
    ["lissom.Polyline"] = function(picture, line) picture.lines[#picture.lines + 1] = corners_of(line) end,
}

function add_value(picture, value, style, transform, depth)
    if type(value) == "table" and (depth or 0) < 3 then
        for _, one in pairs(value) do add_value(picture, one, style, transform, (depth or 0) + 1) end
        return
    end
    local add = adders[kind_of(value)]
    if not add or picture.seen[value] then return end
    picture.seen[value] = true
    add(picture, value, style or {}, transform)
end

local function new_picture()
    return { name = "result", meshes = {}, strands = {}, lines = {}, hair = {}, styles = {}, seen = {} }
end

--- The picture of a scene.
function playground.scene_picture(scene)
    local picture = new_picture()
    add_scene(picture, scene)
    return picture
end

local function returned_picture(...)
    local picture = new_picture()
    for i = 1, select("#", ...) do add_value(picture, (select(i, ...))) end
    picture.seen = nil
    if #picture.meshes == 0 and #picture.strands == 0 then return nil end
    return picture
end

-- Presets finish their hair by scripts/hairdo.lua: a hand goes on with their styles.
function package.preload.hairdo(name)
    local hairdo = assert(loadfile("/lissom/scripts/hairdo.lua"))(name)
    local finish = hairdo.finish
    function hairdo.finish(style, ...)
        table.insert(playground.finished, style)
        return finish(style, ...)
    end
    return hairdo
end

-- Whether the script has returned styles alone, for tools: pictures of their hair are drawn already.
local function is_only_styles(picture)
    return #picture.styles > 0 and #picture.strands == 0 and not picture.scene
        and #picture.meshes == #picture.styles
end

function playground.shown(...)
    local pictures = playground.pictures
    playground.pictures = {}
    local returned = returned_picture(...)
    playground.styles = returned and returned.styles or {}
    if #playground.styles == 0 then playground.styles = playground.finished end
    if returned and not (#pictures > 0 and is_only_styles(returned)) then
        table.insert(pictures, 1, returned)
    end
    playground.drawn = pictures
    return pictures
end

function playground.run(file)
    playground.pictures, playground.finished = {}, {}
    local chunk, problem = loadfile(file)
    if not chunk then error(problem, 0) end
    return playground.shown(chunk())
end

function lissom.render(options)
    if type(options) ~= "table" then
        lissom.error{ message = "lissom.render takes a table of options", level = 3 }
    end
    if options.scene then
        local picture = picture_of{ file = options.file, view = options.view, camera = options.camera,
            up = options.up }
        picture.seen, picture.scene = {}, options.scene
        add_scene(picture, options.scene)
        picture.seen = nil
        table.insert(playground.pictures, picture)
        return options.file
    end
    table.insert(playground.pictures, picture_of(options))
    return options.file
end

_G.playground = playground
