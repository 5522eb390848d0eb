-- The host of tools: calls a tool's functions with a hand's input, each in a step of the scene. It
-- returns the functions that the binding calls; its reference is in tools.cpp. `error` is Lua's,
-- but for an error object; new_error makes one.
local lissom, hear, guard, now, load_script, find_file, name_hint, new_error, error, new_view, marks_of,
    event_fields = ...

local try = lissom.try

local function fail(text, code) error(new_error(text, code)) end

local Tool, Event, Host = { __name = "lissom.Tool" }, {}, { __name = "lissom.ToolHost" }
Tool.__tostring = function(tool) return "lissom.Tool: " .. rawget(tool, "name") end
Host.__tostring = function(host) return "lissom.ToolHost: " .. (host.tool and host.tool.name or "no tool") end

local function set_of(names)
    local set = {}
    for _, name in ipairs(names) do set[name] = true end
    return set
end

-- The hint behind an error about a name: the nearest of the keys of these tables, or all of them.
local function hint(name, ...)
    local names = {}
    for _, keys in ipairs{ ... } do
        for key in pairs(keys) do
            if type(key) == "string" and key:sub(1, 2) ~= "__" then table.insert(names, key) end
        end
    end
    table.sort(names)
    return name_hint(tostring(name), names)
end

-- Objects of a class have these fields and its methods, and raise an error about any other name. Fields of
-- the library's own are not named there.
local function name_members(class, what, fields, own)
    class.__index = function(_, key)
        local method = rawget(class, key)
        if method ~= nil or fields[key] or own and own[key] then return method end
        error(what .. ": no field or method '" .. tostring(key) .. "'" .. hint(key, class, fields), 2)
    end
end

name_members(Event, "lissom.ToolEvent", set_of{ "kind", "camera", "scene", "size", "up", "x", "y",
    "start", "button", "pressure", "shift", "ctrl", "alt", "late", "key", "lines", "seconds", "parameter" })
name_members(Host, "lissom.ToolHost", set_of{ "scene", "camera", "size", "tool" }, set_of{ "asked", "base",
    "begun", "brings_up", "depth", "drawn", "draws", "exported", "guarded", "held", "hover", "is_made",
    "journal", "kept", "known_hash", "log", "looked", "numbers", "opened", "prompted", "request", "thread",
    "typed", "word", "working", "x", "y", "z_up" })

local function misuse(text, ...) error(string.format(text, ...), 3) end

-- ---- Tools

local callbacks = { "activate", "press", "drag", "release", "move", "wheel", "tick", "key", "changed", "draw",
    "cancel", "deactivate", "run" }
local is_callback = set_of(callbacks)

-- Whether one letter left out of one of two words gives the other.
local function lacks_a_letter(long, short)
    if #long ~= #short + 1 then return false end
    for i = 1, #long do
        if long:sub(1, i - 1) .. long:sub(i + 1) == short then return true end
    end
    return false
end

local function check_callback(key, value)
    if is_callback[key] and type(value) ~= "function" then
        fail("a tool's '" .. key .. "' is a function, not a " .. type(value))
    end
    if is_callback[key] or type(value) ~= "function" or type(key) ~= "string" then return end
    for _, name in ipairs(callbacks) do
        if lacks_a_letter(name, key) or lacks_a_letter(key, name) then
            fail("the host never calls '" .. key .. "'; did you mean '" .. name ..
                "'? A function of the tool's own needs a name less like it")
        end
    end
end

local function make_tool(tool)
    if type(tool.name) ~= "string" or tool.name == "" then fail("a tool needs a name, a string") end
    if tool.help ~= nil and type(tool.help) ~= "string" then fail("the help of a tool is a string") end
    for key, value in pairs(tool) do check_callback(key, value) end
    if tool.run and not tool.press and (tool.drag or tool.release) then
        fail("a tool that asks (run) has drag and release for gestures that its press takes: give it one")
    end
    tool.params = lissom.params(tool.params or {}, { command_line = false })
    tool.state = tool.state or {}
    return setmetatable(tool, Tool)
end

local function is_tool(value) return type(value) == "table" and getmetatable(value) == Tool end

-- ---- Events

local function filled(event, options)
    local all = { scene = event.scene, size = event.size }
    for key, value in pairs(options or {}) do all[key] = value end
    if all.mesh or all.meshes then all.scene = nil end
    return all
end

function Event:ray() return self.camera:ray(self.x, self.y, self.size) end

function Event:pick(options)
    local all = filled(self, options)
    all.x, all.y = self.x, self.y
    return self.camera:pick(all)
end

function Event:hit() return self:pick() end

-- By event: the host that calls the tool.
local callers = setmetatable({}, { __mode = "k" })

-- Not noted: a recording comes to it again by the tool.
function Event:look(camera)
    local host = callers[self]
    if not (host and host.working) then error("ev:look is for the functions of a tool that runs", 2) end
    if type(camera) ~= "userdata" then error("ev:look takes a camera", 2) end
    host:see_by(camera)
    host.looked, self.camera = true, host.camera
end

function Event:select(options) return self.camera:select(filled(self, options)) end

-- Returns the fault of a field of an event, described as a parameter of a function; nil if it has
-- none.
local function event_flaw(name, value, field)
    if value == nil and not field.required then return nil end
    local choices = field.choices and set_of(field.choices)
    if choices and not choices[value] then
        return "has no " .. name .. " '" .. tostring(value) .. "'" .. hint(value, choices)
    end
    local unit = field.unit ~= "" and " of " .. field.unit or ""
    local expected = "needs " .. name .. ", a " .. field.kind .. unit
    if type(value) ~= field.kind then return expected end
    if field.kind == "number" and not (value >= field.min and value <= field.max) then
        return expected .. string.format(" from %g to %g", field.min, field.max)
    end
    return nil
end

local function check_event(what, fields)
    if type(fields) ~= "table" then misuse("an event of the %s is a table", what) end
    local known = event_fields[what]
    for key in pairs(fields) do
        if type(key) ~= "string" or not known[key] then
            misuse("an event of the %s has no '%s'%s", what, tostring(key), hint(key, known))
        end
    end
    for _, name in ipairs(known) do
        local flaw = event_flaw(name, fields[name], known[name])
        if flaw then misuse("an event of the %s %s", what, flaw) end
    end
end

function Host:event(kind, fields)
    local held = self.held or {}
    local event = { kind = kind, camera = self.camera, scene = self.scene, size = self.size,
        up = self:up_axis(), x = self.x, y = self.y, start = held.start, button = held.button,
        pressure = 1, shift = false, ctrl = false, alt = false }
    for key, value in pairs(fields or {}) do event[key] = value end
    callers[event] = self
    return setmetatable(event, Event)
end

-- ---- Steps. A gesture, from press to release, is one; any other work of a tool is one of its own.

-- By scene: the host whose step is open. Hosts of one scene take turns.
local holders = setmetatable({}, { __mode = "kv" })

local function other_holder(host)
    local holder = holders[host.scene]
    return holder ~= host and holder or nil
end

function Host:begin()
    self.depth = self.scene:depth()
    holders[self.scene] = self
    self.scene:begin(self.tool.name)
    self.guarded = guard(self.scene, self.scene:depth())
    if self.journal then self.journal:begin_step() end
end

-- While a function of the tool runs, the journal hears its calls.
function Host:start_work(name)
    self.working = true
    if not self.journal then return end
    self.journal:begin_group(name == "drag" or name == "wheel" or name == "tick")
    hear(self.journal)
end

function Host:end_work()
    hear(nil)
    self.working = false
end

function Host:take_back()
    local depth = self.depth
    self.depth, self.held = nil, nil
    if depth then
        holders[self.scene] = nil
        guard(self.scene, self.guarded)
    end
    while depth and self.scene:depth() > depth do self.scene:rollback() end
end

-- Also a step, or nothing if that fails too.
function Host:cancel_after_failure()
    local cancel = self.tool and self.tool.cancel
    if not cancel then return end
    self:begin()
    if self.journal then hear(self.journal) end
    local done = pcall(cancel, self.tool, self:event("cancel"))
    hear(nil)
    if not done or self.scene:depth() ~= self.depth + 1 then return self:take_back() end
    self:mark(self:commit())
end

-- The message goes on after the scene is as it was before the step.
function Host:fail(message)
    hear(nil)
    local held = self.held ~= nil
    self:take_back()
    self:forget_failed(held)
    self.thread, self.request, self.hover = nil, nil, nil
    self:cancel_after_failure()
    self.working = false
    local asks, asked = self.tool and self.tool.run, self.asked
    self.asked = false
    if asks and asked then pcall(self.start_run, self) end
    error(message, 0)
end

function Host:call(name, event)
    local callback = self.tool and self.tool[name]
    if not callback then return end
    self:start_work(name)
    local done, result = pcall(callback, self.tool, event)
    if not done then self:fail(result) end
    self:end_work()
    return result
end

function Host:commit()
    if self.scene:depth() ~= self.depth + 1 then
        self:fail(new_error("the tool '" .. self.tool.name ..
            "' began or ended a step; its host does that"))
    end
    self.depth, holders[self.scene] = nil, nil
    guard(self.scene, self.guarded)
    local changed = self.scene:commit()
    if self.journal then self.journal:end_step(self.tool.name, changed) end
    return changed
end

function Host:step(name, event)
    if not (self.tool and self.tool[name]) then return end
    if self.depth then return self:call(name, event) end
    self:begin()
    self:call(name, event)
    self:mark(self:commit())
end

-- Remains of a broken-off call: a script that was stopped from outside leaves its step open.
function Host:recover()
    if other_holder(self) then return self end          -- the open step is not this host's
    local broken = self.working or self.held or self.scene:depth() > self.base
    self:end_work()
    self:take_back()
    guard(self.scene, 0)
    while self.scene:depth() > self.base do self.scene:rollback() end
    if not broken then return self end      -- a run that waits goes on waiting
    self:forget_unfinished()
    self.thread, self.request, self.hover = nil, nil, nil
    return self
end

function Host:ready()
    if self.working then error("a function of the tool runs, or was stopped; see recover", 3) end
    local other = other_holder(self)
    if other then
        error("another host is in the middle of a gesture of '" .. other.tool.name ..
            "' on this scene; release or cancel that before", 3)
    end
end

-- ---- Prompts of tools that run as coroutines

local pick_kinds = { point = "face", object = "face", face = "face", vertex = "vertex", edge = "edge",
    boundary = "boundary" }

-- The answer under the cursor, or nil.
function Host:candidate(event)
    local request = self.request
    local kind = request and pick_kinds[request.kind]
    if not kind then return nil end
    local hit = event:pick{ kinds = { kind }, radius = request.radius }
    if not hit or (request.object and hit.object ~= request.object) then return nil end
    if request.kind == "boundary" then hit.boundary = hit.mesh:boundaries()[hit.index] end
    return hit
end

function Host:resume(...)
    local opened = not self.depth
    if opened then self:begin() end
    self.request, self.hover, self.typed = nil, nil, ""
    self:start_work("run")
    local done, request = coroutine.resume(self.thread, ...)
    if not done then self:fail(request) end
    local waits = coroutine.status(self.thread) == "suspended"
    if waits and not (type(request) == "table" and request.kind) then
        self:fail(new_error("the run of a tool waits for nothing but the answers of lissom.pick"))
    end
    self:end_work()
    if opened then self:mark(self:commit()) end
    if waits then
        self.request, self.asked = request, true
    else
        self.thread = nil
    end
end

-- A run that has ended begins again if it has asked for anything.
function Host:start_run()
    if not (self.tool and self.tool.run) or self.thread then return end
    self.asked = false
    self.thread = coroutine.create(self.tool.run)
    self:resume(self.tool, self:event("run"))
end

function Host:answer(value)
    self:resume(value)
    if not self.thread and self.asked then self:start_run() end
end

local function typed_number(text, default)
    if text == "" then return default end
    return tonumber(text)
end

function Host:prompt_key(event)
    local request = self.request
    if event.key == "enter" then
        if request.kind == "confirm" then return self:answer(true) end
        if request.kind == "number" then
            local value = typed_number(self.typed, request.default)
            if value then return self:answer(value) end
            self.typed = ""
        end
        if request.optional then return self:answer(nil) end
    elseif request.kind == "number" then
        if event.key == "backspace" then self.typed = self.typed:sub(1, -2) end
        if event.key:match("^[%d.eE+-]$") then self.typed = self.typed .. event.key end
    end
end

-- ---- Input of a hand

-- The scene keeps the values of a tool's parameters that are not their defaults.
function Host:keep_parameters()
    local values = {}
    for _, p in ipairs(self.tool.params:schema()) do
        if p.value ~= p.default then values[p.name] = p.value end
    end
    self.scene:set_parameters(self.tool.name, values)
end

-- A tool takes the values that the scene keeps for it; values given meanwhile are dropped first.
function Host:take_parameters()
    local kept = self.scene:parameters(self.tool.name)
    if not kept then return end
    for _, p in ipairs(self.tool.params:schema()) do
        if kept[p.name] ~= nil and p.value == p.default then
            pcall(function() self.tool.params[p.name] = kept[p.name] end)
        end
    end
end

-- `word` is the tool's word in a recording, if that is not its name.
function Host:use(tool, word)
    self:ready()
    if tool ~= nil and not is_tool(tool) then error("a tool is a result of lissom.tool", 2) end
    self:cancel_quietly()
    local before, noted = self.tool, self.log and #self.log
    if self.tool and not tool then self:note{ "tool" } end
    self:step("deactivate", self:event("deactivate"))
    if self.tool then self:keep_parameters() end        -- a tool may have changed them itself
    self.tool = tool
    self.hover = nil
    if tool then
        self:take_parameters()
        self:keep_parameters()
        self:note{ "tool", word or tool.name }
        for _, p in ipairs(tool.params:schema()) do
            if p.value ~= p.default then self:note{ "set", { [p.name] = p.value } } end
        end
    end
    local done, message = pcall(self.begin_tool, self)
    if done then return self end
    -- The one before stays in hand, and nothing of this is repeated.
    self.tool = before
    while self.log and #self.log > noted do table.remove(self.log) end
    pcall(self.begin_tool, self)
    error(message, 0)
end

function Host:begin_tool()
    self:step("activate", self:event("activate"))
    self:start_run()
end

-- A camera made of the numbers of another, as a recording makes it.
local function camera_numbers(camera)
    return { eye = camera:eye(), target = camera:target(), up = camera:up(),
        fov = camera:fov(), ortho = camera:ortho() }
end

local function checked_size(size)
    for i = 1, 2 do
        local pixels = type(size) == "table" and size[i]
        if type(pixels) ~= "number" or pixels % 1 ~= 0 or pixels < 1 or pixels > 65536 then
            error("a size is {width, height} in pixels, each from 1 to 65536", 3)
        end
    end
    return { size[1], size[2] }
end

-- Sees the scene by a camera of these numbers, to which the same numbers in a recording lead again.
function Host:look_by(numbers)
    self:ready()
    -- Pixels of a gesture are those of the picture that it began in.
    local size = checked_size(numbers.size)
    if self.held and (size[1] ~= self.size[1] or size[2] ~= self.size[2]) then self:cancel() end
    self:take_numbers(numbers)
    self:note{ "look", self.numbers }
    return self
end

function Host:take_numbers(numbers)
    self.size = checked_size(numbers.size)
    self.camera = lissom.camera{ eye = numbers.eye, target = numbers.target, up = numbers.up,
        fov = numbers.fov, ortho = numbers.ortho }
    self.z_up = numbers.z_up or nil
    self.numbers = { eye = numbers.eye, target = numbers.target, up = numbers.up, fov = numbers.fov,
        ortho = numbers.ortho, size = self.size, z_up = self.z_up }
end

-- The axis of the world that points up in views.
function Host:up_axis() return self.z_up and "z" or "y" end

-- A tool looks by another camera.
function Host:see_by(camera)
    local numbers = camera_numbers(camera)
    numbers.size, numbers.z_up = self.size, self.z_up
    self:take_numbers(numbers)
end

function Host:look(camera, size)
    self:ready()
    if type(camera) ~= "userdata" then error("look takes a camera", 2) end
    local numbers = camera_numbers(camera)
    numbers.size, numbers.z_up = checked_size(size or self.size), self.z_up
    return self:look_by(numbers)
end

local function mouse_note(kind, event)
    return { kind, event.x, event.y, button = event.button ~= "left" and event.button or nil,
        pressure = event.pressure ~= 1 and event.pressure or nil,
        shift = event.shift or nil, ctrl = event.ctrl or nil, alt = event.alt or nil }
end

function Host:place(fields)
    check_event("mouse", fields)
    self.x, self.y = fields.x, fields.y
end

function Host:press(fields)
    self:ready()
    self:place(fields)
    if self.held then error("a button is down already; release it first", 2) end
    if not self.tool then return self end
    local button = fields.button or "left"
    local event = self:event("press", fields)
    event.button, event.start = button, { fields.x, fields.y }
    self:note(mouse_note("press", event))
    self:begin()
    self.held = { button = button, start = event.start }
    -- A gesture answers the question of a tool, unless its press takes it.
    local is_taken = self:call("press", event) == true
    self.held.answers = self.tool.run and not is_taken
    return self
end

function Host:move(fields)
    self:ready()
    self:place(fields)
    if not self.tool then return self end
    local event = self:event(self.held and "drag" or "move", fields)
    if self.held then
        self:note(mouse_note("move", event))
        if not self.held.answers then self:call("drag", event) end
    elseif self.tool.move then
        self:note(mouse_note("move", event))
        self:step("move", event)
    else
        self.hover = self:candidate(event)
    end
    return self
end

-- A gesture that only showed something.
function Host:end_without_step()
    self:take_back()
    if self.journal then self.journal:end_step(self.tool.name, false) end
    self:mark(false)
    return self
end

function Host:release(fields)
    self:ready()
    self:place(fields)
    if not self.held then return self end
    local event = self:event("release", fields)
    self:note(mouse_note("release", event))
    if self.held.answers then
        local hit = self:candidate(event)
        if hit then self:answer(hit) end
    elseif self:call("release", event) == false then
        return self:end_without_step()
    end
    self.held = nil
    self:mark(self:commit())
    return self
end

-- In a gesture it is part of that, else a step of its own.
function Host:wheel(fields)
    self:ready()
    check_event("wheel", fields)
    self.x, self.y = fields.x, fields.y
    if not (self.tool and self.tool.wheel) then return self end
    self:note{ "wheel", fields.x, fields.y, fields.lines, shift = fields.shift or nil,
        ctrl = fields.ctrl or nil, alt = fields.alt or nil }
    self:step("wheel", self:event("wheel", fields))
    return self
end

-- Time that passes while a button is down: part of the gesture.
function Host:tick(fields)
    self:ready()
    check_event("clock", fields)
    if not (self.held and self.tool and self.tool.tick) or self.held.answers then return self end
    self:note{ "tick", fields.seconds }
    self:call("tick", self:event("tick", fields))
    return self
end

function Host:click(fields) return self:press(fields):release(fields) end

function Host:key(fields)
    self:ready()
    check_event("key", fields)
    if fields.key == "escape" then return self:cancel() end
    if not self.tool then return self end
    local shift, ctrl, alt = fields.shift or nil, fields.ctrl or nil, fields.alt or nil
    self:note{ "key", fields.key, shift = shift, ctrl = ctrl, alt = alt }
    local event = self:event("key", fields)
    if self.request then self:prompt_key(event) else self:step("key", event) end
    return self
end

function Host:type(text)
    for character in tostring(text):gmatch("[^\128-\191][\128-\191]*") do self:key{ key = character } end
    return self
end

function Host:set(values)
    self:ready()
    if not self.tool then error("there is no tool whose parameters could be set", 2) end
    if type(values) ~= "table" then error("set takes a table of values", 2) end
    local names = {}
    for name in pairs(values) do table.insert(names, name) end
    table.sort(names)
    for _, name in ipairs(names) do
        local before = self.tool.params[name]
        self.tool.params[name] = values[name]
        self:keep_parameters()
        self:note{ "set", { [name] = values[name] } }
        local event = self:event("changed")
        event.parameter = name
        if self.tool.params[name] ~= before then self:step("changed", event) end
    end
    return self
end

function Host:cancel_quietly()
    local held = self.held
    self:take_back()
    self.thread, self.request, self.hover = nil, nil, nil
    return held ~= nil
end

-- Escape: the present gesture is taken back; the tool forgets its beginnings.
function Host:cancel()
    self:ready()
    if not self.tool then return self end
    self:note{ "cancel" }
    self:cancel_quietly()
    self:step("cancel", self:event("cancel"))
    self:start_run()
    return self
end

function Host:travel(verb)
    self:ready()
    if self.held then return self:cancel() and nil end
    self:cancel_quietly()
    self:note{ verb }
    local name = self.scene[verb](self.scene)
    self:mark(name ~= nil)
    if self.journal and name then table.insert(self.journal.lines, "scene:" .. verb .. "()") end
    self:start_run()
    return name
end

-- Shows or hides an object of the scene: a step of its own.
function Host:show(name, visible)
    self:ready()
    visible = visible and true or false
    if self.held then self:cancel() end
    self:note{ "show", name, visible }
    local known = try(self.scene.info, self.scene, name)
    if known and known.visible ~= visible then
        self.scene:set(name, { visible = visible })
        local line = string.format("scene:set(%q, { visible = %s })", name, tostring(visible))
        if self.journal then table.insert(self.journal.lines, line) end
    end
    self:mark(true)
    return self
end

function Host:undo() return self:travel("undo") end
function Host:redo() return self:travel("redo") end

