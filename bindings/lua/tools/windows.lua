-- ---- For windows

-- The modules that the tool loaded last has brought along.
local tool_modules = {}

-- The values of parameters that are not their defaults.
local function changed_values(tool)
    local values = {}
    for _, p in ipairs(tool.params:schema()) do
        if p.value ~= p.default then values[p.name] = p.value end
    end
    return values
end

-- Values that another version of the tool refuses are left out.
local function take_values(tool, values)
    for name, value in pairs(values) do pcall(function() tool.params[name] = value end) end
end

-- `told` is the tool's word in a recording.
local function use(host, word, told)
    if word == "" then
        host.word = nil
        return host:use(nil)
    end
    local old, kept = host.tool, {}
    for _, name in ipairs(tool_modules) do
        kept[name], package.loaded[name] = package.loaded[name], nil
    end
    local before = {}
    for name in pairs(package.loaded) do before[name] = true end
    local done, tool = pcall(load_tool, word)
    if not done then
        for name, module in pairs(kept) do package.loaded[name] = module end
        error(tool, 0)
    end
    tool_modules = {}
    for name in pairs(package.loaded) do
        if not before[name] then table.insert(tool_modules, name) end
    end
    local before_run, word_before = host.kept, host.word
    host.kept = nil
    if old and old.name == tool.name then
        tool.state = old.state
        take_values(tool, changed_values(old))
    elseif before_run and before_run.name == tool.name then
        tool.state = before_run.state
        take_values(tool, before_run.values)
    end
    host.word = word
    local used, message = pcall(host.use, host, tool, told or word)
    if used then return host end
    host.word = word_before
    error(message, 0)
end

-- The files that the present tool was read from.
local function tool_files(word)
    local files = { word:match("%.lua$") and word or package.searchpath("tools." .. word, package.path) }
    for _, name in ipairs(tool_modules) do table.insert(files, (package.searchpath(name, package.path))) end
    return files
end

-- Who keeps the camera among the parameters of a scene.
local view_owner = "window"

-- By scene: the view that it was saved with, until it is seen by that.
local saved_views = setmetatable({}, { __mode = "k" })

-- A camera as plain numbers.
local function view_of(camera)
    local view = { fov = camera:fov(), ortho = camera:ortho() }
    for name, vector in pairs{ eye = camera:eye(), target = camera:target(), up = camera:up() } do
        for i = 1, 3 do view[name .. i] = vector[i] end
    end
    return view
end

local function open_for_window(paths, options)
    local scene = open_scene(paths, options)
    if type(scene) == "userdata" and is_scene_path(paths[1]) then
        saved_views[scene] = scene:parameters(view_owner)
    end
    return scene
end

-- The first look at a scene that was saved in a window is the one that it was saved with.
local function look_in_window(host, numbers)
    local view = saved_views[host.scene]
    if not view then return look(host, numbers) end
    saved_views[host.scene] = nil
    host.brings_up = true
    local saved = { size = numbers.size, fov = view.ortho == nil and view.fov or nil, ortho = view.ortho,
        z_up = view.z_up }
    for _, name in ipairs{ "eye", "target", "up" } do
        saved[name] = { view[name .. 1], view[name .. 2], view[name .. 3] }
    end
    if not pcall(look, host, saved) then return look(host, numbers) end
    host.looked = true
    return host
end

-- Sentences about content without a place in the file.
local function save(host, path)
    local view = view_of(host.camera)
    view.z_up = host.z_up
    host.scene:set_parameters(view_owner, view)
    local _, left_out = host.scene:save(path)
    return table.concat(left_out, "; ")
end

-- The camera that the tool or a saved scene has set since the last call, else nil; and of a saved scene,
-- whether z is up in it.
local function looked(host)
    local camera, z_up = host.looked and host.camera or nil, nil
    if camera and host.brings_up then z_up = host.z_up == true end
    host.looked, host.brings_up = nil, nil
    return camera, z_up
end

-- Draws, and returns the results of `looked`.
local function draw(host)
    host.drawn = nil
    host.prompted = host:prompt()
    host.drawn = host:drawn_view()
    return looked(host)
end

-- The visible mesh of which something is selected, else the only one; and the name and place of its object.
local function mesh_in_hand(scene)
    local found, count, seen = nil, 0, {}
    for _, name in ipairs(scene:names()) do
        local info, object = scene:info(name), scene:get(name)
        local mesh = info.kind == "mesh" and object or info.kind == "deformation" and object:mesh() or nil
        if mesh and info.visible and not seen[mesh] then
            local selected = try(mesh.region, mesh, "selected")
            if selected and #selected > 0 then return mesh, name, info.transform end
            seen[mesh], count, found = true, count + 1, found or { mesh, name, info.transform }
        end
    end
    if count == 1 then return found[1], found[2], found[3] end
    error(count == 0 and "no mesh is to be seen: there is nothing to export"
        or count .. " meshes are to be seen: select vertices of the one to export, or hide the others", 0)
end

-- The only visible hair; and the name and place of its object.
local function hair_in_hand(scene)
    local found, count = nil, 0
    for _, name in ipairs(scene:names()) do
        local info = scene:info(name)
        if info.kind == "strands" and info.visible then
            found, count = { scene:get(name), name, info.transform }, count + 1
        end
    end
    if count == 1 then return found[1], found[2], found[3] end
    error(count == 0 and "no hair is to be seen: there is nothing to export to a file of hair"
        or count .. " objects of hair are to be seen: hide the others", 0)
end

local surfaces, only_hair = set_of{ "mesh", "deformation" }, set_of{ "strands" }

local function shows(scene, kinds)
    for _, name in ipairs(scene:names()) do
        local info = scene:info(name)
        if info.visible and kinds[info.kind] then return true end
    end
    return false
end

-- The objects for a file that may hold `meshes`, `hair` or both.
local function object_in_hand(scene, meshes, hair)
    local without_mesh = not meshes or (not shows(scene, surfaces) and shows(scene, only_hair))
    return (hair and without_mesh and hair_in_hand or mesh_in_hand)(scene)
end

local function exists(path)
    local file = io.open(path, "rb")
    if file then file:close() end
    return file ~= nil
end

-- A name that no file has: that of the object, with a number if needed.
local function free_file(name, ending)
    local base, number = name:gsub("%.%w+$", ""):gsub("[^%w%-_. ]", "_"), 1
    while true do
        local path = base .. (number > 1 and "-" .. number or "") .. ending
        if not exists(path) then return path end
        number = number + 1
    end
end

-- A copy of the mesh or hair in hand for a file, its path, and { name =, transform = } of its object. The
-- path's ending names a format of `meshes`, `hair` or both. A file that this window has not written stays as
-- it is.
local function export(host, path, meshes, hair)
    local object, name, place = object_in_hand(host.scene, meshes, hair)
    local is_hair = type_of(object) == "lissom.Strands"
    host.exported = host.exported or {}
    if path == "" then path = free_file(name, is_hair and ".usda" or ".obj") end
    if exists(path) and not host.exported[path] then
        error(path .. " is there already, and was not written by this window: give another name", 0)
    end
    local copy = object:copy()
    if not is_hair and try(copy.region, copy, "selected") then copy:remove_region("selected") end
    return copy, path, { name = name, transform = place }
end

-- Writes such a copy, and says so.
local function write_export(host, copy, path, object)
    copy:save(path)
    host.exported[path] = true
    local counts = type_of(copy) == "lissom.Strands"
        and string.format("%d strands", #copy)
        or string.format("%d vertices, %d faces", #copy, copy:face_count())
    return "exported " .. object.name .. " to " .. path .. ": " .. counts
end

-- Whether one of the values is an object of the scene, or the scene itself.
local function holds(host, ...)
    for i = 1, select("#", ...) do
        local value = select(i, ...)
        if rawequal(value, host.scene) then return true end
        for _, name in ipairs(host.scene:names()) do
            if rawequal(host.scene:get(name), value) then return true end
        end
    end
    return false
end

-- ---- State that stays when a script runs again, in a Lua state of its own: the selection, and the
-- tool's parameters and state, as far as these are numbers, texts and tables of them.

local function plain_text(value, depth)
    if type(value) == "string" or type(value) == "boolean" then return text_of(value) end
    if type(value) == "number" then return value - value == 0 and text_of(value) or nil end
    if type(value) ~= "table" or getmetatable(value) or depth > 8 then return nil end
    local parts = {}
    for key, item in next, value do
        local text = type(key) ~= "boolean" and type(key) ~= "table" and plain_text(item, depth + 1)
        local name = text and plain_text(key, depth)
        if name then table.insert(parts, "[" .. name .. "] = " .. text) end
    end
    return "{ " .. table.concat(parts, ", ") .. " }"
end

-- The meshes of a scene by name.
local function each_mesh(scene, visit)
    for _, name in ipairs(scene:names()) do
        if scene:info(name).kind == "mesh" then visit(name, scene:get(name)) end
    end
end

local function keep(host)
    local selected, tool = {}, host.tool
    each_mesh(host.scene, function(name, mesh)
        local region = try(mesh.region, mesh, "selected")
        if region then selected[name] = { count = mesh:vertex_count(), vertices = region:vertices() } end
    end)
    local kept = tool and { name = tool.name, values = changed_values(tool), state = tool.state }
    return plain_text({ selected = selected, tool = kept }, 0)
end

-- The selection only if it `selects`, and of meshes with as many vertices as before: no step.
local function restore(host, text, selects)
    local before = load("return " .. text, "=kept", "t", {})()
    host.kept = before.tool
    if not selects then return end
    each_mesh(host.scene, function(name, mesh)
        local one = before.selected[name]
        if one and one.count == mesh:vertex_count() then
            mesh:set_region("selected", mesh:region{ vertices = one.vertices })
            if host.journal then host.journal:hear_selected(name, one.vertices) end
        end
    end)
    host.scene:clear_history()
    if host.journal then table.insert(host.journal.lines, "scene:clear_history()") end
end

return { tool = make_tool, is_tool = is_tool, host = make_host, replay = replay, open = open_for_window,
    load_tool = load_tool, host_of = host_of, look = look_in_window, use = use, tool_files = tool_files,
    draw = draw, holds = holds, save = save, export = export, write_export = write_export, methods = Host,
    sketch = sketch,
    open_recording = open_recording, play = play, keep = keep,
    restore = restore }
