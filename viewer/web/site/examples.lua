-- Runs the examples of the guide and the reference, and draws those that make something to see.
--
--     SITE_FOLDER=FOLDER lissom run viewer/web/site/examples.lua
--
-- FOLDER/list.lua returns { { id =, names = { locals } }, ... } and FOLDER/ID.lua is the script of each.
-- Written are FOLDER/ID.png, and FOLDER/results.txt with lines "ID <tab> ok <tab> the call that draws it, or
-- nothing" or "ID <tab> failed <tab> the error".
local lissom = require "lissom"

local folder = os.getenv("SITE_FOLDER")
local size = { 400, 300 }

local function read(path)
    local file <close> = assert(io.open(path, "rb"))
    return file:read("a")
end

local function kind_of(value) return type(value) == "userdata" and getmetatable(value) or type(value) end

local function holds(list, value)
    for _, one in ipairs(list) do if one == value then return true end end
    return false
end

-- The results of an example by their kind: names in order, each value once.
local function sorted(names, values)
    local found, seen = {}, {}
    for _, name in ipairs(names) do
        local value = values[name]
        local kind = kind_of(value)
        local list = seen[kind] or {}
        if value ~= nil and not holds(list, value) then
            list[#list + 1] = value
            seen[kind], found[kind] = list, found[kind] or {}
            table.insert(found[kind], name)
        end
    end
    return function(kind) return found["lissom." .. kind] or found[kind] or {} end
end

local function is_numbers_of(value, mesh)
    local kind = kind_of(value)
    if kind ~= "table" and kind ~= "lissom.Buffer" or #value ~= #mesh then return false end
    return type(value[1]) == "number"
end

-- Options that draw upon one mesh.
local function marks(mesh, named, values)
    local more = ""
    local path, region = named("Path"), named("Region")
    if #path > 0 then more = more .. ", paths = { " .. table.concat(path, ", ") .. " }" end
    if #region > 0 then more = more .. ", region = " .. region[#region] end
    for name, value in pairs(values) do
        if is_numbers_of(value, values[mesh]) then return ", scalars = " .. name end
    end
    return more
end

local function of_meshes(names, named, values)
    if #names == 1 then return "mesh = " .. names[1] .. marks(names[1], named, values) end
    local captions = {}
    for i = 1, math.min(#names, 4) do captions[i] = ("%q"):format(names[i]) end
    local columns = #captions > 3 and 2 or #captions
    return ("meshes = { %s }, columns = %d, fit = \"each\",\n    captions = { %s }"):format(
        table.concat(names, ", ", 1, #captions), columns, table.concat(captions, ", "))
end

local function of_strands(strands, meshes)
    for _, name in ipairs(meshes) do
        if name == "head" then return "mesh = head, strands = " .. strands end
    end
    return (meshes[1] and "mesh = " .. meshes[1] .. ", " or "") .. "strands = " .. strands
end

local function shown(names, values)
    local named = sorted(names, values)
    local meshes, strands = named("Mesh"), named("Strands")
    local styles, scenes = named("Hairstyle"), named("Scene")
    if #strands > 0 then return of_strands(strands[#strands], meshes) end
    if #styles > 0 then return "style = " .. styles[#styles] end
    if #meshes > 0 then return of_meshes(meshes, named, values) end
    if #scenes > 0 then return "scene = " .. scenes[1] end
end

local function run(text, name)
    local chunk = assert(load(text, "=" .. name))
    return chunk()
end

local function local_values(id, text, names)
    local rows = {}
    for i, name in ipairs(names) do rows[i] = name .. " = " .. name end
    local whole = text .. "\nreturn { " .. table.concat(rows, ", ") .. " }"
    -- One that returns something itself is shown by that.
    if not load(whole) then
        run(text, id)
        return {}
    end
    return run(whole, id)
end

-- Parameters are declared once: a second example that does so has nothing wrong with it.
local function is_fault(problem) return not tostring(problem):find("declared already", 1, true) end

-- The call that draws an example, if it can be drawn.
local function drawn(id, text, names, values)
    local what = shown(names, values)
    if not what then return "" end
    local call = ("lissom.render{ %s, file = \"picture.png\" }"):format(what)
    local render = lissom.render
    lissom.render = function(options)
        if options.file ~= "picture.png" then return render(options) end
        options.file, options.size = folder .. "/" .. id .. ".png", size
        options.background, options.captions = "transparent", nil
        return render(options)
    end
    local ok = pcall(run, text .. "\n" .. call, id)
    lissom.render = render
    return ok and call or ""
end

local results = assert(io.open(folder .. "/results.txt", "w"))
for _, example in ipairs(dofile(folder .. "/list.lua")) do
    local text = read(folder .. "/" .. example.id .. ".lua")
    local ok, values = pcall(local_values, example.id, text, example.names)
    if not ok and not is_fault(values) then ok, values = true, {} end
    local answer = ok and drawn(example.id, text, example.names, values) or tostring(values)
    if ok and answer:find("^table:") then answer = "" end
    results:write(example.id, "\t", ok and "ok" or "failed", "\t", (answer:gsub("\n", "\\n")), "\n")
    collectgarbage()
end
results:close()
