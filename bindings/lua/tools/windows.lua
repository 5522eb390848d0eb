-- ---- For windows

-- The modules that the tool loaded last has brought along.
local tool_modules = {}

-- `told` is what a recording calls the tool.
local function use(host, word, told)
    if word == "" then return host:use(nil) end
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
    if old and old.name == tool.name then
        tool.state = old.state
        for _, p in ipairs(old.params:schema()) do
            if p.value ~= p.default then pcall(function() tool.params[p.name] = p.value end) end
        end
    end
    return host:use(tool, told or word)
end

-- The files that the present tool was read from.
local function tool_files(word)
    local files = { word:match("%.lua$") and word or package.searchpath("tools." .. word, package.path) }
    for _, name in ipairs(tool_modules) do table.insert(files, (package.searchpath(name, package.path))) end
    return files
end

-- Sentences about what had no place in the file.
local function save(host, path)
    local done, left_out, code = host.scene:save(path)
    if not done then error(left_out .. " [" .. code .. "]", 0) end
    return table.concat(left_out, "; ")
end

local function draw(host)
    host.drawn = nil
    host.prompted = host:prompt()
    host.drawn = host:draw()
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

local function method(host, name, ...) return host[name](host, ...) end

return { tool = make_tool, host = make_host, replay = replay, open = open_scene, load_tool = load_tool,
    host_of = host_of, look = look, use = use, tool_files = tool_files, draw = draw, holds = holds,
    save = save, method = method, sketch = sketch, open_recording = open_recording, play = play,
    event_kind = event_kind }
