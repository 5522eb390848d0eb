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

-- `told` is what a recording calls the tool.
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
    local saved = { size = numbers.size, fov = view.ortho == nil and view.fov or nil, ortho = view.ortho }
    for _, name in ipairs{ "eye", "target", "up" } do
        saved[name] = { view[name .. 1], view[name .. 2], view[name .. 3] }
    end
    if not pcall(look, host, saved) then return look(host, numbers) end
    host.looked = true
    return host
end

-- Sentences about what had no place in the file.
local function save(host, path)
    host.scene:set_parameters(view_owner, view_of(host.camera))
    local done, left_out, code = host.scene:save(path)
    if not done then error(left_out .. " [" .. code .. "]", 0) end
    return table.concat(left_out, "; ")
end

local function draw(host)
    host.drawn = nil
    host.prompted = host:prompt()
    host.drawn = host:draw()
end

-- The camera that the tool has set since the last call, else nil.
local function looked(host)
    local camera = host.looked and host.camera or nil
    host.looked = nil
    return camera
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

-- ---- What stays when a script runs again, in a Lua state of its own: what was selected, and the tool's
-- parameters and state, as far as these are numbers, texts and tables of them.

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
        local region = mesh:region("selected")
        if region then selected[name] = { count = mesh:vertex_count(), vertices = region:vertices() } end
    end)
    local kept = tool and { name = tool.name, values = changed_values(tool), state = tool.state }
    return plain_text({ selected = selected, tool = kept }, 0)
end

-- What was selected only where it `selects`, and of meshes with as many vertices as before: no step.
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

local function method(host, name, ...) return host[name](host, ...) end

return { tool = make_tool, is_tool = is_tool, host = make_host, replay = replay, open = open_for_window,
    load_tool = load_tool, host_of = host_of, look = look_in_window, use = use, tool_files = tool_files,
    draw = draw, holds = holds, save = save, method = method, sketch = sketch,
    open_recording = open_recording, play = play, event_kind = event_kind, looked = looked, keep = keep,
    restore = restore }
