-- ---- Journals: the calls that tools have made, as a script that makes them again without a hand.

-- The effect of a method on its object stands in the registration table (Effect): it reaches a
-- journal as a word.
local changing = set_of{ "changes", "replaces" }

local Untold = {}

local function untold(text) error(setmetatable({ text = text }, Untold), 0) end

-- ---- Hearing calls

-- Calls see(object) for the objects that a value holds; whether there is one.
local function see_objects(value, see, depth)
    if type(value) == "userdata" then
        see(value)
        return true
    end
    local any = false
    if type(value) ~= "table" or depth > 6 then return any end
    for _, item in next, value do
        local kind = type(item)
        if kind == "userdata" or kind == "table" then any = see_objects(item, see, depth + 1) or any end
    end
    return any
end

-- A present copy of a table, with the results of `see` for the objects that it holds.
local function copied(value, see, depth)
    if type(value) == "userdata" then return see(value) end
    if type(value) ~= "table" or depth > 6 then return value end
    local copy = {}
    for key, item in next, value do copy[key] = copied(item, see, depth + 1) end
    return copy
end

-- Origin of an object that no call of this step has made; nil if that cannot be told.
local function origin(scene, object)
    local kind = type_of(object)
    if kind == "lissom.Region" then return { region = object:mesh(), ids = object:vertices() } end
    if kind == "lissom.Path" then
        local mesh = object:mesh()
        for i, loop in ipairs(object:is_boundary() and mesh:boundaries() or {}) do
            if loop:vertices()[1] == object:vertices()[1] and #loop == #object then
                return { boundary = mesh, index = i }
            end
        end
        return { path = mesh, ids = object:vertices(), closed = object:is_closed() }
    end
    for _, name in ipairs(scene:names()) do
        local held = scene:get(name)
        if rawequal(held, object) then return { name = name } end
        if kind == "lissom.Handle" and type_of(held) == "lissom.Deformer" then
            for i, handle in ipairs(held:handles()) do
                if handle == object then return { handle = held, index = i } end
            end
        end
        if kind == "lissom.Bones" and type_of(held) == "lissom.Deformer" then
            for i, bones in ipairs(held:bones()) do
                if bones == object then return { bones = held, index = i } end
            end
        end
    end
    return nil
end

-- One journal hears one host while that runs a function of its tool.
local Journal = {}
Journal.__index = Journal

-- Objects of which there may be several for one handle or one chain of bones.
local several = set_of{ "lissom.Handle", "lissom.Bones" }

-- One object for all that are the same handle or chain.
function Journal:same(object)
    if not several[type_of(object)] then return object end
    for _, handle in ipairs(self.handles) do
        if type_of(handle) == type_of(object) and handle == object then return handle end
    end
    table.insert(self.handles, object)
    return object
end

function Journal:see(object)
    if self.made[object] or self.origins[object] then return end
    local found = origin(self.host.scene, object)
    if not found then return end
    self.origins[object] = found
    local owner = found.region or found.boundary or found.path or found.handle or found.bones
    if owner then self:see(owner) end
end

function Journal:before(kind, name, effect, ...)
    if not self.host.working then return end
    local given = { ... }
    see_objects(given, function(object) self:see(self:same(object)) end, 0)
    self.pending = { kind = kind, name = name, effect = effect, count = select("#", ...), given = given }
end

function Journal:after(kind, name, effect, ...)
    local call = self.pending
    if not call or call.kind ~= kind or call.name ~= name then return end
    self.pending = nil
    local results = { ... }
    local first = type(call.given[1]) == "userdata" and self:same(call.given[1])
    local itself = kind and first and rawequal(first, self:same((...)))
    call.shapes = effect == "shapes" and first or nil
    call.changes = not call.shapes and (itself or changing[effect]) or false
    local makes = see_objects(results, function() end, 0)
    if not (call.changes or call.shapes or makes) then return end
    call.results, call.arguments = {}, {}
    local function made(object)
        object = self:same(object)
        if not itself then self.made[object] = self.made[object] or { call = call } end
        return object
    end
    for i, result in pairs(results) do call.results[i] = copied(result, made, 0) end
    for i = 1, call.count do
        call.arguments[i] = copied(call.given[i], function(object) return self:same(object) end, 0)
    end
    call.given = nil
    table.insert(self.group, call)
end

-- The calls of one function of the tool; those of a drag may be replaced by those of the next.
function Journal:begin_group(is_drag)
    self.group = { drag = is_drag }
    table.insert(self.groups, self.group)
end

function Journal:begin_step()
    self.groups, self.made, self.origins, self.handles, self.pending = {}, {}, {}, {}, nil
    for _, name in ipairs(self.host.scene:names()) do
        self.origins[self.host.scene:get(name)] = { name = name }
    end
    self:begin_group(false)
end

-- ---- Leaving out calls that the next drag replaces

-- A number of its own for each mesh or deformer, however alike two are.
local numbers = setmetatable({}, { __mode = "k" })
local last_number = 0

local function number_of(mesh)
    if not numbers[mesh] then
        last_number = last_number + 1
        numbers[mesh] = last_number
    end
    return numbers[mesh]
end

local function part_of(mesh, what, which) return number_of(mesh) .. " " .. what .. " " .. tostring(which) end

local function target(call)
    if call.effect ~= "replaces" then return nil end
    if call.name == "set_pose" then return part_of(call.arguments[1], "pose") end
    if call.kind ~= "lissom.Mesh" then return call.arguments[1] end
    return part_of(call.arguments[1], call.name:match("region$") or call.name, call.arguments[2])
end

-- Source of a call that another replaces: a region by its name.
local function source(call)
    local reads = call.kind == "lissom.Mesh" and call.name == "region" and type(call.arguments[2]) == "string"
    return reads and part_of(call.arguments[1], "region", call.arguments[2]) or nil
end

-- Targets of each call of a group, if all of it is replaced first of all; and the targets that are
-- not read before, so that groups before this one leave nothing of them.
local function targets(group, owner_of)
    local replaced, all, read = {}, {}, {}
    for _, call in ipairs(group) do
        local from = source(call)
        if from and not replaced[from] then read[from] = true end
        if call.changes then
            local key = target(call) or (call.kind == "lissom.Handle" and call.arguments[1])
            local deformer = call.kind == "lissom.Bones" and owner_of(call.arguments[1])
            if deformer then key = part_of(deformer, "pose") end
            if not key then return nil end
            if target(call) then replaced[key] = true end
            if not replaced[key] then return nil end
            all[key] = true
        end
    end
    local renewed = {}
    for key in pairs(all) do renewed[key] = not read[key] or nil end
    return all, renewed
end

local function told_groups(groups, owner_of)
    local kept, later = {}, nil
    for i = #groups, 1, -1 do
        local group = groups[i]
        local own, renewed
        if group.drag then own, renewed = targets(group, owner_of) end
        local replaced = own and later
        for key in pairs(own or {}) do replaced = replaced and later[key] end
        if not replaced then table.insert(kept, 1, group) end
        if own and not later then later = renewed end
        if not group.drag then later = nil end
    end
    return kept
end

-- ---- Telling

local Writer = {}
Writer.__index = Writer

local function ranges(ids)
    local parts, i = {}, 1
    while i <= #ids do
        local last = i
        while ids[last + 1] == ids[last] + 1 do last = last + 1 end
        table.insert(parts, last > i and ids[i] .. "-" .. ids[last] or tostring(ids[i]))
        i = last + 1
    end
    return 'ids"' .. table.concat(parts, " ") .. '"'
end

local function quoted(text) return (string.format("%q", text):gsub("\n", "n")) end

local function is_word(text) return type(text) == "string" and text:match("^[%a_][%w_]*$") ~= nil end
local reserved = set_of{ "and", "break", "do", "else", "elseif", "end", "false", "for", "function", "goto",
    "if", "in", "local", "nil", "not", "or", "repeat", "return", "then", "true", "until", "while", "lissom",
    "scene", "ids", "made" }

-- A function has 200 local variables at most.
local max_locals = 150

function Writer:local_name(wanted)
    wanted = wanted:lower():gsub("[^%w_]", "_"):gsub("^%d", "_%0")
    local name, number = wanted, 1
    while self.taken[name] or reserved[name] do
        number = number + 1
        name = wanted .. number
    end
    self.taken[name] = true
    self.count = self.count + 1
    return self.count > max_locals and "made." .. name or name
end

-- The statement that gives variables their value.
function Writer:assign(names, text)
    if #names == 0 then return self:line(text) end
    local declares = names[#names]:sub(1, 5) ~= "made." and "local " or ""
    self:line(declares .. table.concat(names, ", ") .. " = " .. text)
end

function Writer:line(text) table.insert(self.lines, "    " .. text) end

-- Gives an object a local variable with this text as its value.
function Writer:bind(object, wanted, text)
    local name = self:local_name(wanted)
    self.names[object] = name
    self:assign({ name }, text)
    return name
end

function Writer:object(object)
    if self.names[object] then return self.names[object] end
    local from = self.journal.origins[object]
    if not from then untold("no call tells its origin " .. tostring(object) .. " comes from") end
    if from.name then
        return self:bind(object, from.name, "scene:get(" .. quoted(from.name) .. ")")
    elseif from.handle then
        return self:object(from.handle) .. ":handles()[" .. from.index .. "]"
    elseif from.bones then
        return self:object(from.bones) .. ":bones()[" .. from.index .. "]"
    elseif from.region then
        return self:object(from.region) .. ":region{ vertices = " .. ranges(from.ids) .. " }"
    elseif from.boundary then
        return self:object(from.boundary) .. ":boundaries()[" .. from.index .. "]"
    end
    return self:object(from.path) .. ":path{ points = " .. ranges(from.ids) .. ", closed = " ..
        tostring(from.closed) .. " }"
end

function Writer:value(value)
    if type(value) == "userdata" then return self:object(value) end
    if type(value) == "string" then return quoted(value) end
    if type(value) == "number" then return number_text(value) end
    if type(value) == "function" then untold("a function was given to a call") end
    if type(value) ~= "table" then return tostring(value) end
    local parts, keys = {}, {}
    for _, item in ipairs(value) do table.insert(parts, self:value(item)) end
    for key in pairs(value) do
        if type(key) == "string" then table.insert(keys, key) end
    end
    table.sort(keys)
    for _, key in ipairs(keys) do
        local name = is_word(key) and not reserved[key] and key or "[" .. quoted(key) .. "]"
        table.insert(parts, name .. " = " .. self:value(value[key]))
    end
    return "{ " .. table.concat(parts, ", ") .. " }"
end

function Writer:call_text(call)
    local texts = {}
    for i = 1, call.count do texts[i] = self:value(call.arguments[i]) end
    local start = "lissom." .. call.name
    if call.kind then start = table.remove(texts, 1) .. ":" .. call.name end
    if #texts == 1 and texts[1]:sub(1, 1) == "{" then return start .. texts[1] end
    return start .. "(" .. table.concat(texts, ", ") .. ")"
end

-- The variables that hold the objects a call has made; one for the table if they are in one.
function Writer:write(call)
    local text, names = self:call_text(call), {}
    local first = call.arguments[1]
    local itself = call.kind and rawequal(call.results[1], first)
    for i, result in ipairs(itself and {} or call.results) do
        local kind = type_of(result)
        names[i] = "_"
        if type(result) == "userdata" and not self.names[result] then
            local wanted = (call.kind == "lissom.Scene" and call.arguments[2]) or kind:match("%.(.*)$")
            names[i] = self:local_name(wanted)
            self.names[result] = names[i]
        elseif type(result) == "table" then
            names[i] = self:local_name(call.name)
            for key, item in next, result do
                if type(item) == "userdata" then
                    local at = type(key) == "string" and "." .. key or "[" .. tostring(key) .. "]"
                    self.names[item] = self.names[item] or names[i] .. at
                end
            end
        end
    end
    while names[#names] == "_" do table.remove(names) end
    -- Names before the limit and names behind it are not declared together.
    if #names > 1 and (names[1]:find("^made%.") ~= nil) ~= (names[#names]:find("^made%.") ~= nil) then
        untold("there are too many objects in one step")
    end
    self:assign(names, text)
end

-- The calls that change something, but for those that are replaced, and those that made objects in
-- use.
function Journal:needed_calls()
    local needed = {}
    -- The deformer of a chain of bones.
    local function owner_of(bones)
        local from, made = self.origins[bones], self.made[bones]
        return from and from.bones or made and made.call.arguments[1]
    end
    local function need(call)
        if needed[call] then return end
        needed[call] = true
        copied(call.arguments, function(object)
            local made = self.made[object]
            if made and not made.call.changes then need(made.call) end
            return object
        end, -1)
    end
    for _, group in ipairs(told_groups(self.groups, owner_of)) do
        for _, call in ipairs(group) do
            if call.changes then need(call) end
        end
    end
    for _, group in ipairs(self.groups) do
        for _, call in ipairs(group) do
            local made = call.shapes and self.made[call.shapes]
            if made and needed[made.call] then need(call) end
        end
    end
    return needed
end

-- The lines of a step.
function Journal:told(name)
    local writer = setmetatable({ journal = self, lines = {}, taken = {}, count = 0,
        names = { [self.host.scene] = "scene" } }, Writer)
    local done, trouble = pcall(function()
        local needed = self:needed_calls()
        for _, group in ipairs(self.groups) do
            for _, call in ipairs(group) do
                if needed[call] then writer:write(call) end
            end
        end
    end)
    if not done and getmetatable(trouble) ~= Untold then error(trouble, 0) end
    if not done then return { "-- " .. quoted(name) .. ": " .. trouble.text .. "; record events instead" } end
    local lines = writer.lines
    if writer.count > max_locals then table.insert(lines, 1, "    local made = {}") end
    table.insert(lines, 1, "scene:step(" .. quoted(name) .. ", function()")
    table.insert(lines, "end)")
    return lines
end

function Journal:end_step(name, changed)
    if changed then
        for _, line in ipairs(self:told(name)) do table.insert(self.lines, line) end
    end
    self.groups = {}
    self.group = {}
end

-- A line of a console that was done between steps: told with those before it, which it may need, once one
-- changes the scene.
function Journal:hear_console(line, changed, failed)
    if failed then
        line = "pcall(function() " .. line .. " end)"
    elseif not load(line, "=console", "t") then
        line = "do local _ = " .. line .. " end"
    end
    table.insert(self.console, line)
    if not changed then return end
    table.insert(self.lines, "-- From the console.")
    for _, one in ipairs(self.console) do table.insert(self.lines, one) end
    self.console = {}
end

-- Selection for a script that runs again.
function Journal:hear_selected(name, ids)
    local mesh = "scene:get(" .. quoted(name) .. ")"
    local region = string.format("%s:region{ vertices = %s }", mesh, ranges(ids))
    table.insert(self.lines, string.format('%s:set_region("selected", %s)', mesh, region))
end

local ids_text = [[
-- The numbers that "1-3 7" stands for.
local function ids(text)
    local list = {}
    for first, last in text:gmatch("(%d+)%-?(%d*)") do
        for i = tonumber(first), tonumber(last) or tonumber(first) do table.insert(list, i) end
    end
    return list
end]]

-- `is_made`: a script's result is no scene, and was put into one.
local function opening_lines(open, load, is_made)
    if not open then return { "local scene = ...      -- the scene that this was done to" } end
    if #open == 1 and is_scene_path(open[1]) then
        return { string.format("local scene = assert(lissom.load_scene(%q))", open[1]) }
    end
    if #open == 1 and open[1]:match("%.lua$") then
        local folder = open[1]:match("^(.*)[/\\]")
        local opened = is_made and "lissom.replay{ version = 1, open = { %q }, events = {} }" or "dofile(%q)"
        local lines = { string.format("local scene = assert(" .. opened .. ")", open[1]) }
        local path = folder and string.format("package.path = %q .. package.path", folder .. "/?.lua;")
        if path then table.insert(lines, 1, path) end
        return lines
    end
    local lines, scene = { "local scene = lissom.scene{}" }, lissom.scene{}
    for _, path in ipairs(open) do
        local name = free_name(scene, stem(path))
        scene:add(name, lissom.polyline{ points = { { 0, 0, 0 }, { 1, 0, 0 } } })
        local arguments = string.format("%q", path) .. (load and ", " .. text_of(load) or "")
        table.insert(lines, string.format("scene:add(%q, assert(lissom.load(%s)))", name, arguments))
    end
    return lines
end

--- Begins a journal, as record begins a recording.
function Host:keep_journal(open, load)
    self:ready()
    self.journal = setmetatable({ host = self, lines = {}, console = {} }, Journal)
    self.journal.open = open and #open > 0 and open or nil
    self.journal.load = load and next(load) and load or nil
    self.journal:begin_step()
    return self
end

function Host:journal_text()
    if not self.journal then error("no journal is kept; see keep_journal", 2) end
    if self.held then error("a gesture is not finished: release the button first", 2) end
    local text = { "-- What was done with tools, as calls.", 'local lissom = require "lissom"', "" }
    local body = table.concat(self.journal.lines, "\n")
    if body:find('ids"', 1, true) then table.insert(text, ids_text .. "\n") end
    local opening = opening_lines(self.journal.open, self.journal.load, self.is_made)
    for _, line in ipairs(opening) do table.insert(text, line) end
    if body ~= "" then table.insert(text, body) end
    table.insert(text, string.format("assert(scene:hash() == %q)", self.scene:hash()))
    table.insert(text, "return scene\n")
    return table.concat(text, "\n")
end

