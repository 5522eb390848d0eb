-- ---- Recordings: input of a hand, as a script that repeats it.

-- Seconds between looks, or hovers, that are all kept in timed recordings.
local shortest = 0.05

-- Adds an event to the recording, if one is made; with its time in seconds if that is measured.
function Host:note(event)
    if not self.log then return end
    event.t = self.begun and math.floor(1000 * (now() - self.begun) + 0.5) / 1000 or nil
    local last, before = self.log[#self.log], self.log[#self.log - 1]
    local replaces = last and last[1] == event[1] and not last.hash and not self.held
    if event.t then replaces = replaces and before and event.t - before.t < shortest end
    if replaces and (event[1] == "look" or event[1] == "move") then table.remove(self.log) end
    table.insert(self.log, event)
end

-- A recording does not repeat failures: the tool only saw its cancel.
function Host:forget_failed(held)
    if not self.log then return end
    while held and #self.log > 0 and self.log[#self.log][1] ~= "press" do table.remove(self.log) end
    if #self.log > 0 then self.log[#self.log] = { "cancel", t = self.log[#self.log].t } end
end

-- A gesture or an event that was broken off is not in the recording.
function Host:forget_unfinished()
    local log = self.log or {}
    for i = #log, 1, -1 do
        if log[i][1] == "press" then return self:forget_failed(true) end
        if log[i][1] ~= "move" then break end
    end
    if #log > 0 and log[#log][1] ~= "look" and log[#log][1] ~= "tool" then self:forget_failed(false) end
end

-- A line of a console follows.
function Host:begin_outside()
    if self.journal then self.journal.hash = self.scene:hash() end
end

-- It was done, or has failed: its changes are in the journal, but not in the recording, which says
-- so.
function Host:changed_outside(line, failed)
    local journal = self.journal
    if journal then journal:hear_console(line, self.scene:hash() ~= journal.hash, failed) end
    if not self.log or self.scene:hash() == self.known_hash then return false end
    self:note{ "outside" }
    self:mark(true)
    return true
end

local function hash_of(object)
    local done, hash = pcall(function() return object:hash() end)
    return done and hash or nil
end

-- The hash of each object of a scene, by its name.
local function object_hashes(scene)
    local hashes = {}
    for _, name in ipairs(scene:names()) do hashes[name] = hash_of(scene:get(name)) end
    return hashes
end

-- Pairs of a name and a hash for the objects that differ from those known before; nil for none.
function Host:changed_objects()
    local known, list = self.known_objects or {}, {}
    self.known_objects = object_hashes(self.scene)
    for name, hash in pairs(self.known_objects) do
        if known[name] ~= hash then table.insert(list, { name, hash }) end
    end
    table.sort(list, function(a, b) return a[1] < b[1] end)
    return #list > 0 and list or nil
end

-- The hash that the scene has after the event noted last, if that changed it, and those of the objects that
-- it changed.
function Host:mark(changed)
    if not (self.log and changed and #self.log > 0) then return end
    local last = self.log[#self.log]
    self.known_hash = self.scene:hash()
    last.hash, last.objects = self.known_hash, self:changed_objects()
end

-- Begins a recording; `open` names the files of the scene, if it is as they were opened with the
-- options `load` of lissom.load. Its events have times if it is `timed`.
function Host:record(open, load, timed)
    self:ready()
    if self.tool then error("record before a tool is used: its state is not in a recording", 2) end
    self.known_hash = self.scene:hash()
    self.known_objects = object_hashes(self.scene)
    self.opened = { open = open and #open > 0 and open or nil, hash = self.scene:hash() }
    self.opened.load = self.opened.open and load and next(load) and load
    self.log = {}
    self.begun = timed and now() or nil
    self:note{ "look", self.numbers }
    return self
end

-- The shortest text that reads as the same number.
local function number_text(value)
    if value == 0 then return 1 / value < 0 and "-0.0" or "0" end
    if value % 1 == 0 and math.abs(value) < 2 ^ 53 then return string.format("%d", value) end
    for digits = 15, 17 do
        local text = string.format("%." .. digits .. "g", value)
        if tonumber(text) == value then return text end
    end
    return tostring(value)
end

local function text_of(value)
    if type(value) == "string" then return string.format("%q", value) end
    if type(value) == "number" then
        return number_text(value)
    end
    if type(value) ~= "table" then return tostring(value) end
    local parts, keys = {}, {}
    for _, item in ipairs(value) do table.insert(parts, text_of(item)) end
    for key in pairs(value) do
        if type(key) == "string" then table.insert(keys, key) end
    end
    table.sort(keys)
    for _, key in ipairs(keys) do table.insert(parts, key .. " = " .. text_of(value[key])) end
    return "{ " .. table.concat(parts, ", ") .. " }"
end

function Host:recording()
    if not self.log then error("nothing is recorded; see record", 2) end
    if self.held then error("a gesture is not finished: release the button first", 2) end
    local lines = { "-- What was done with tools; lissom run does it again." }
    table.insert(lines, 'return (require("lissom").replay{')
    table.insert(lines, "    version = 1,")
    if self.opened.open then table.insert(lines, "    open = " .. text_of(self.opened.open) .. ",") end
    if self.opened.load then table.insert(lines, "    load = " .. text_of(self.opened.load) .. ",") end
    table.insert(lines, '    before = "' .. self.opened.hash .. '",')
    table.insert(lines, "    events = {")
    for _, event in ipairs(self.log) do table.insert(lines, "        " .. text_of(event) .. ",") end
    table.insert(lines, "    },")
    table.insert(lines, '    after = "' .. self.scene:hash() .. '",')
    table.insert(lines, "})\n")
    return table.concat(lines, "\n")
end

-- ---- Opening

local function stem(path) return (path:gsub("^.*[/\\]", ""):gsub("%.[^.]*$", "")) end

local function free_name(scene, name)
    local free, number = name, 1
    local taken = set_of(scene:names())
    while taken[free] do
        number = number + 1
        free = name .. " " .. number
    end
    return free
end

local function new_host(scene, camera, size, up)
    size = type(size) == "number" and { size, size } or size or { 1280, 960 }
    local host = setmetatable({ scene = scene, typed = "", base = scene:depth() }, Host)
    host.z_up = up == "z" or nil
    return host:look(camera, checked_size(size))
end

local function type_of(value)
    if type(value) ~= "userdata" then return type(value) end
    local meta = getmetatable(value)
    return type(meta) == "string" and meta or "userdata"
end

local in_scenes = set_of{ "lissom.Mesh", "lissom.Deformer", "lissom.Strands", "lissom.Hairstyle",
    "lissom.Polyline" }

-- Adds the objects that a scene can hold, also from tables within tables, under the keys that they
-- have there.
local function add_values(scene, value, name, seen, depth)
    if in_scenes[type_of(value)] then
        if not seen[value] then scene:add(free_name(scene, name), value) end
        seen[value] = true
    elseif type(value) == "table" and not is_tool(value) and depth < 4 and not seen[value] then
        seen[value] = true
        local keys = {}
        for key in next, value do table.insert(keys, key) end
        table.sort(keys, function(a, b) return tostring(a) < tostring(b) end)
        for _, key in ipairs(keys) do
            local label = type(key) == "string" and key ~= "" and key or name
            add_values(scene, rawget(value, key), label, seen, depth + 1)
        end
    end
end

-- The host of the first scene among the values, or of a scene of the other values; nil for nothing.
-- The making of the scene is not for a hand to undo.
local function host_of(...)
    local scene, is_made
    for i = 1, select("#", ...) do
        local value = select(i, ...)
        if not scene and type_of(value) == "lissom.Scene" then scene = value end
    end
    if not scene then
        scene = lissom.scene{}
        for i = 1, select("#", ...) do add_values(scene, (select(i, ...)), "object", {}, 0) end
        if #scene == 0 then return nil end
        is_made = true
    end
    scene:clear_history()
    local host = new_host(scene, lissom.camera{ eye = { 0, 0, 5 } })
    host.is_made = is_made
    return host
end

local function run_script(path)
    local host = host_of(load_script(path)())
    if not host then fail(path .. " returns no scene, nor an object for one") end
    return host.scene
end

-- Whether scene:save wrote a path: a .lissom file, or a folder.
local function is_scene_path(path)
    if path:match("%.lissom$") then return true end
    return find_file(path .. "/scene.json") == true
end

-- The scene of mesh files, of one saved scene or of one script; options are those of lissom.load.
local function open_scene(paths, options)
    if #paths == 1 and paths[1]:match("%.lua$") then return run_script(paths[1]) end
    if #paths == 1 and is_scene_path(paths[1]) then
        return lissom.load_scene(paths[1])
    end
    local scene = lissom.scene{}
    for _, path in ipairs(paths) do
        scene:add(free_name(scene, stem(path)), lissom.load(path, options))
    end
    scene:clear_history()
    return scene
end

-- The tool that a word names: a file, or one of those that ship; a new table each time.
local function load_tool(word)
    local path = word
    if not word:match("%.lua$") then
        path = package.searchpath("tools." .. word, package.path)
        if not path then
            fail("there is no tool '" .. word .. "': name one of scripts/tools, or a .lua file")
        end
    end
    local chunk = load_script(path)
    local folder = (path:match("^(.*[/\\])") or "./") .. "?.lua"
    if not (";" .. package.path .. ";"):find(";" .. folder .. ";", 1, true) then
        package.path = folder .. ";" .. package.path
    end
    local tool = chunk()
    if not is_tool(tool) then
        fail(path .. " does not return a tool; end it with return lissom.tool{...}")
    end
    return tool
end

-- ---- Replaying

local function folder_of(path) return path:match("^(.*[/\\])") or "" end

-- Place of a file that a recording in `folder` names.
local function place_of(path, folder)
    if not path:match("^[/\\]") and not path:match("^%a:") then path = folder .. path end
    local found, reason = find_file(path)
    if not found then
        fail("the recording needs a file that cannot be opened: " .. reason ..
            " (paths in a recording begin at its own folder)", "file_not_found")
    end
    return path
end

local function tool_place(word, folder) return word:match("%.lua$") and place_of(word, folder) or word end

-- A tool that takes the place of one of the same name has its state, as in a window.
local function tool_for(host, word, given, folder)
    for _, tool in ipairs(given or {}) do
        if tool.name == word then
            for _, p in ipairs(tool.params:schema()) do tool.params[p.name] = p.default end
            return tool
        end
    end
    local tool = load_tool(tool_place(word, folder))
    if host.tool and host.tool.name == tool.name then tool.state = host.tool.state end
    return tool
end

local function look(host, numbers) return host:look_by(numbers) end

local player = {
    look = function(host, event) look(host, event[2]) end,
    tool = function(host, event, tools, folder)
        local tool = event[2] and tool_for(host, event[2], tools, folder)
        host:use(tool, event[2])
    end,
    set = function(host, event) host:set(event[2]) end,
    key = function(host, event)
        host:key{ key = event[2], shift = event.shift, ctrl = event.ctrl, alt = event.alt }
    end,
    wheel = function(host, event)
        host:wheel{ x = event[2], y = event[3], lines = event[4], shift = event.shift, ctrl = event.ctrl,
            alt = event.alt }
    end,
    tick = function(host, event) host:tick{ seconds = event[2] } end,
    cancel = function(host) host:cancel() end,
    outside = function()
        fail("a script or a console changed the scene here, which is not in the recording")
    end,
    show = function(host, event) host:show(event[2], event[3]) end,
    undo = function(host) host:undo() end,
    redo = function(host) host:redo() end,
}
for _, kind in ipairs{ "press", "move", "release" } do
    player[kind] = function(host, event)
        host[kind](host, { x = event[2], y = event[3], button = kind == "press" and event.button or nil,
            pressure = event.pressure, shift = event.shift, ctrl = event.ctrl, alt = event.alt })
    end
end

-- The table that a file of a recording gives to lissom.replay; the file is run for nothing else.
local function recording_of(path)
    local recorded
    local catcher = { replay = function(t) recorded = t end }
    load_script(path, { require = function() return catcher end })()
    if type(recorded) ~= "table" then fail(path .. " is no recording", "file_syntax") end
    return recorded
end

local function difference(scene, wanted, what)
    local hash = wanted and scene:hash()
    if hash == wanted then return nil end
    return string.format("the recording differs %s: the scene has the hash %s, recorded was %s", what, hash,
        wanted)
end

local function same_or_error(scene, wanted, what)
    local text = difference(scene, wanted, what)
    if text then fail(text) end
end

local function check_recording(recorded)
    if recorded.version ~= 1 then
        fail("this program reads recordings of version 1; this one has " .. tostring(recorded.version))
    end
    if type(recorded.events) ~= "table" then fail("a recording has a list of events") end
    for i, event in ipairs(recorded.events) do
        if type(event) ~= "table" or not player[event[1]] then
            fail("event " .. i .. " of the recording is of no known kind")
        end
    end
end

-- The scene before the first event, made of the files that the recording names.
local function recorded_scene(recorded, folder)
    if type(recorded.open) ~= "table" then
        fail("the recording names no files: give it a scene (scene=)")
    end
    local paths = {}
    for _, path in ipairs(recorded.open) do table.insert(paths, place_of(tostring(path), folder)) end
    return open_scene(paths, recorded.load), paths
end

local function check_beginning(recorded, scene)
    same_or_error(scene, recorded.before, "before its first event: it was made with another scene or mesh")
end

-- The number of the line of each event in the file of a recording, which has one a line; nil for a file that
-- is laid out otherwise.
local function event_lines(path, count)
    local done, file = pcall(function() return io.open(path, "rb") end)
    if not (done and file) then return nil end
    local lines, number, inside = {}, 0, false
    for line in file:lines() do
        number = number + 1
        if inside and line:match("^%s*},?%s*$") then break end
        if inside and line:match('^%s*{%s*"%a+"') then table.insert(lines, number) end
        inside = inside or line:match("^%s*events%s*=%s*{%s*$") ~= nil
    end
    file:close()
    return #lines == count and lines or nil
end

-- "events.lua:12", or nil.
local function event_place(recorded, i, path)
    local lines = path and event_lines(path, #recorded.events)
    return lines and path:match("[^/\\]*$") .. ":" .. lines[i]
end

-- Which objects are not as they were recorded: "'ball' and 'hat' differ: ", or "".
local function differing_objects(scene, event)
    local names = {}
    for _, pair in ipairs(event.objects or {}) do
        local object = try(scene.get, scene, pair[1])
        if not object or hash_of(object) ~= pair[2] then table.insert(names, "'" .. pair[1] .. "'") end
    end
    if #names == 0 then return "" end
    return table.concat(names, " and ") .. (#names == 1 and " differs: " or " differ: ")
end

-- The text of an error, and the line of the script that it names, if any.
local function text_and_place(problem)
    if type(problem) ~= "string" then return tostring(problem), type(problem) == "table" and problem.place end
    problem = problem:gsub("^lissom tools:%d+: ", "")
    local place, text = problem:match("^(%S-:%d+): (.*)$")
    return text or problem, place
end

-- Raises the problem of an event, at the line of a script if it names one, else that of the event.
local function refuse_event(problem, event, i, own)
    local text, place = text_and_place(problem)
    if place and own then text = text .. " (the event is " .. own .. ")" end
    local whole = new_error("event " .. i .. ", " .. event[1] .. ": " .. text)
    if type(problem) == "table" then whole.code, whole.elements = problem.code, problem.elements end
    whole.place = place or own or whole.place
    error(whole)
end

-- Does an event; says if the scene differs then.
local function play_event(host, recorded, i, tools, folder, path)
    local event = recorded.events[i]
    local done, problem = pcall(player[event[1]], host, event, tools, folder)
    if not done then refuse_event(problem, event, i, event_place(recorded, i, path)) end
    local text = difference(host.scene, event.hash, "at event " .. i .. ", " .. event[1])
    if not text then return nil end
    local own = event_place(recorded, i, path)
    return (own and own .. ": " or "") .. differing_objects(host.scene, event) .. text
end

local function replay(recorded, options)
    local folder, path = options.folder, options.path
    if type(recorded) == "string" then
        folder, path = folder_of(recorded), recorded
        recorded = recording_of(recorded)
    end
    check_recording(recorded)
    local scene = options.scene or recorded_scene(recorded, folder)
    check_beginning(recorded, scene)
    local host = new_host(scene, lissom.camera{ eye = { 0, 0, 5 } })
    for i in ipairs(recorded.events) do
        local text = play_event(host, recorded, i, options.tools, folder, path)
        if text then fail(text) end
    end
    host:use(nil)
    same_or_error(scene, recorded.after, "at its end")
    return scene
end

-- ---- Playing a recording in a window, event by event

-- Seconds between events that have no times.
local usual_step = 1 / 60

-- The scene of a recording's beginning, the files that it was opened from, the state for `play`,
-- and the times and kinds of the events.
local function open_recording(path)
    local recorded, folder = recording_of(path), folder_of(path)
    check_recording(recorded)
    local scene, paths = recorded_scene(recorded, folder)
    check_beginning(recorded, scene)
    local times, kinds, last = {}, {}, 0
    for i, event in ipairs(recorded.events) do
        local time = type(event.t) == "number" and event.t or last + usual_step
        last = time > last and time or last
        times[i], kinds[i] = last, event[1]
    end
    return scene, paths, { recorded = recorded, folder = folder, path = path }, times, kinds
end

-- Does an event. Returns the first difference after this event, whether there is any, and the tool
-- that it takes in hand.
local function play(host, playing, i)
    local recorded = playing.recorded
    local event = recorded.events[i]
    local text = play_event(host, recorded, i, nil, playing.folder, playing.path)
    if i == #recorded.events and not text then text = difference(host.scene, recorded.after, "at its end") end
    local is_first = text and not playing.differs
    playing.differs = playing.differs or text ~= nil
    local tool = event[1] == "tool" and (event[2] and tool_place(event[2], playing.folder) or "") or nil
    return is_first and text or nil, playing.differs, tool
end

local function make_host(options)
    local host = new_host(options.scene, options.camera, options.size, options.up)
    if options.tool then host:use(options.tool) end
    return host
end

