-- The globals `test` and `expect` of `lissom test`. Each file has a process of its own; functions
-- that Lua lacks come from the host that runs it:
--
--     host.settings            filter, list, seed, timeout, finished (tests that need not run again)
--     host.call(action, limit) calls it; nil, or its error: { message =, file =, line =, code = }
--     host.report(event)       reports an event
--     host.no_picture()        why pictures cannot be compared here, or nil
--     host.folder()            a new folder for the files of the running test
--     host.picture(check)      compares two picture files: nil, or their difference
--
-- It runs under Lua 5.4 and under LuaJIT. Returns the runner of the tests that a file declares.
local host = ...
local settings = host.settings

-- ---- Values as text

local function number_text(value)
    if value ~= value then return "nan" end
    local text = string.format("%.14g", value)
    return tonumber(text) == value and text or string.format("%.17g", value)
end

local function string_text(value)
    local shown = #value > 300 and value:sub(1, 300) or value
    local text = string.format("%q", shown):gsub("\\\n", "\\n")
    return shown == value and text or text .. "... (" .. #value .. " bytes)"
end

local function shortened(text)
    return #text > 120 and text:sub(1, 117) .. "..." or text
end

local function is_name(key)
    return type(key) == "string" and key:find("^[%a_][%w_]*$") ~= nil
end

-- The keys of a table behind its list, in an order that does not change.
local function other_keys(value, count)
    local keys = {}
    for key in pairs(value) do
        if not (type(key) == "number" and key >= 1 and key <= count and key % 1 == 0) then
            keys[#keys + 1] = key
        end
    end
    table.sort(keys, function(a, b)
        if type(a) ~= type(b) then return type(a) < type(b) end
        if type(a) == "number" then return a < b end
        return tostring(a) < tostring(b)
    end)
    return keys
end

local show

local function table_text(value, depth)
    if depth > 2 then return "{...}" end
    local parts, room = {}, 12
    local function add(text)
        if #parts < room then parts[#parts + 1] = text end
        return #parts < room
    end
    for i = 1, #value do
        if not add(show(value[i], depth + 1)) then break end
    end
    for _, key in ipairs(other_keys(value, #value)) do
        local name = is_name(key) and key or "[" .. show(key, depth + 1) .. "]"
        if not add(name .. " = " .. show(value[key], depth + 1)) then break end
    end
    if #parts == room then parts[room] = "..." end
    return "{ " .. table.concat(parts, ", ") .. " }"
end

-- A value as a reader wants it in a message.
function show(value, depth)
    local kind, meta = type(value), getmetatable(value)
    if kind == "number" then return number_text(value) end
    if kind == "string" then return string_text(value) end
    if kind ~= "table" or (type(meta) == "table" and meta.__tostring) then
        local done, text = pcall(tostring, value)
        return done and text or kind
    end
    return next(value) == nil and "{}" or table_text(value, depth or 1)
end

-- ---- Comparing

local function path_step(key)
    return is_name(key) and "." .. key or "[" .. show(key) .. "]"
end

-- Returns whether a table is compared by content.
local function is_plain(value)
    local meta = getmetatable(value)
    return type(value) == "table" and not (type(meta) == "table" and meta.__eq)
end

-- The keys of both tables: the list first.
local function all_keys(a, b)
    local count, keys, seen = math.max(#a, #b), {}, {}
    for i = 1, count do keys[i] = i end
    for _, value in ipairs{ b, a } do
        for _, key in ipairs(other_keys(value, count)) do
            if not seen[key] then keys[#keys + 1], seen[key] = key, true end
        end
    end
    return keys
end

-- Returns the first difference of two values: { path =, got =, wanted = }, or nil. Tables are
-- compared by their content, all else by `same`.
local function first_difference(got, wanted, same, compared)
    if not (is_plain(got) and is_plain(wanted)) then
        return not same(got, wanted) and { path = "", got = got, wanted = wanted } or nil
    end
    if rawequal(got, wanted) or compared[got] == wanted then return nil end
    compared[got] = wanted
    for _, key in ipairs(all_keys(got, wanted)) do
        local found = first_difference(got[key], wanted[key], same, compared)
        if found then
            found.path = path_step(key) .. found.path
            return found
        end
    end
end

-- The buffers of meshes are lists of numbers.
local function as_list(value)
    if type(value) ~= "userdata" then return value end
    local done, list = pcall(function() return value:table() end)
    return done and type(list) == "table" and list or value
end

-- ": they differ at byte 512: ..." for texts too long to compare by eye.
local function text_difference(got, wanted)
    if type(got) ~= "string" or type(wanted) ~= "string" or math.max(#got, #wanted) < 60 then return "" end
    local at = 1
    while got:byte(at) == wanted:byte(at) do at = at + 1 end
    local from = math.max(1, at - 20)
    return "\nthey differ at byte " .. at .. ": expected ..." .. string_text(wanted:sub(from, at + 20)) ..
        ", got ..." .. string_text(got:sub(from, at + 20))
end

local function place_of(found)
    return found.path == "" and "" or "at " .. found.path .. ": "
end

local function is_text(value)
    return type(value) == "string" and value ~= ""
end

-- ---- Failures

-- The text of a line of a script, or nil.
local function source_line(info)
    local path = info.source:match("^@(.*)")
    if path == settings.shown then path = settings.path end
    local file = path and io.open(path)
    if not file then return nil end
    local number, found = 0, nil
    for line in file:lines() do
        number = number + 1
        if number == info.currentline then
            found = line
            break
        end
    end
    file:close()
    return found
end

-- The variables that the function at `level` sees.
local function variables_at(level)
    local found, info = {}, debug.getinfo(level + 1, "f")
    for i = 1, 250 do
        local name, value = debug.getupvalue(info.func, i)
        if not name then break end
        found[name] = { value }
    end
    for i = 1, 250 do
        local name, value = debug.getlocal(level + 1, i)
        if not name then break end
        found[name] = { value }
    end
    return found
end

-- Returns "stats.bad" as its value in `variables`, boxed; nil if there is no such variable, or it
-- adds nothing.
local function value_of(chain, variables)
    local box
    for name in chain:gmatch("[^.]+") do
        if box == nil then
            box = variables[name]
        elseif type(box[1]) == "table" then
            box = { rawget(box[1], name) }
        else
            return nil
        end
        if box == nil then return nil end
    end
    return box and type(box[1]) ~= "function" and box or nil
end

-- "\nwith count = 3, stats.bad = 7": the variables in the line at `level`, whose test is not true.
local function variables_text(level)
    local info = debug.getinfo(level + 1, "Sl")
    local line = source_line(info)
    if not line then return "" end
    local variables, parts, seen = variables_at(level + 1), {}, {}
    line = line:gsub("%b\"\"", "\"\""):gsub("%-%-.*", "")
    for before, chain in (" " .. line):gmatch("([^%w_.:])([%a_][%w_.]*)") do
        local box = before ~= "'" and not seen[chain] and value_of(chain, variables)
        seen[chain] = true
        if box and #parts < 6 then parts[#parts + 1] = chain .. " = " .. shortened(show(box[1])) end
    end
    return #parts > 0 and "\nwith " .. table.concat(parts, ", ") or ""
end

-- The message of the expectation that failed last, and why a test leaves off.
local failed_expectation, skip_reason

-- The error of an expectation, at the line that calls it: `fail` is called by the expectation itself.
local function fail(message)
    failed_expectation = message
    error(message, 3)
end

-- The same for an expectation that was called wrongly; `depth` calls lie between.
local function misused(message, depth)
    error(message, 3 + (depth or 0))
end

-- Makes a table that reports names it lacks, with those that it has.
local function strict(name, functions)
    return setmetatable(functions, { __index = function(_, key)
        local names = {}
        for known in pairs(functions) do names[#names + 1] = known end
        table.sort(names)
        error("no '" .. name .. "." .. tostring(key) .. "'; there are: " .. table.concat(names, ", "), 2)
    end })
end

-- ---- expect

local expect = {}

local function equals(a, b) return a == b end

function expect.equal(got, wanted)
    local found = first_difference(got, wanted, equals, {})
    if not found then return end
    fail(place_of(found) .. "expected " .. show(found.wanted) .. ", got " .. show(found.got) ..
        text_difference(found.got, found.wanted))
end

local function near_text(found, tolerance)
    local text = "expected " .. show(found.wanted) .. ", got " .. show(found.got)
    if type(found.got) ~= "number" or type(found.wanted) ~= "number" then return text end
    return text .. string.format(", which is %.3g away (%g allowed)", math.abs(found.got - found.wanted),
        tolerance)
end

function expect.near(got, wanted, tolerance)
    tolerance = tolerance or 1e-9
    if type(tolerance) ~= "number" or not (tolerance >= 0) then
        misused("expect.near: the tolerance must be a number of at least 0, got " .. show(tolerance))
    end
    local function near(a, b)
        if type(a) ~= "number" or type(b) ~= "number" then return a == b end
        return a == b or math.abs(a - b) <= tolerance
    end
    local found = first_difference(as_list(got), as_list(wanted), near, {})
    if found then fail(place_of(found) .. near_text(found, tolerance)) end
end

function expect.truthy(value)
    if value then return value end
    fail("expected a true value, got " .. show(value) .. variables_text(2))
end

function expect.falsy(value)
    if not value then return end
    fail("expected false or nil, got " .. show(value) .. variables_text(2))
end

-- An error as `lissom run` shows it: an error object with its place and code.
local function error_text(raised)
    if type(raised) ~= "table" or not is_text(rawget(raised, "code")) then return tostring(raised) end
    local place = rawget(raised, "place")
    return (place and place .. ": " or "") .. tostring(raised) .. " [" .. raised.code .. "]"
end

function expect.error(action, text)
    if type(action) ~= "function" then
        misused("expect.error: a function to call is needed, got " .. show(action))
    end
    local done, raised = pcall(action)
    local wanted = "expected an error" .. (text and " with " .. show(text) or "")
    if done then fail(wanted .. ", but there was none") end
    if text and not error_text(raised):find(text, 1, true) then
        fail(wanted .. ", got " .. show(error_text(raised)))
    end
    return raised
end

function expect.failure(code, action, ...)
    if type(action) ~= "function" then
        misused("expect.failure: a function to call is needed, got " .. show(action))
    end
    local done, raised = pcall(action, ...)
    if done then fail("expected the failure " .. show(code) .. ", got " .. show(raised)) end
    if type(raised) ~= "table" or raised.code ~= code then
        fail("expected the failure " .. show(code) .. ", got " .. show(error_text(raised)))
    end
    if not is_text(raised.message) then fail("the failure " .. show(code) .. " has no message") end
    return raised
end

function expect.hash(object, wanted)
    local done, hash = pcall(function() return object:hash() end)
    if not done then misused("expect.hash: an object with a hash is needed, got " .. show(object)) end
    if hash ~= wanted then fail("expected the hash " .. show(wanted) .. ", got " .. show(hash)) end
end

-- ---- Pictures

local known_picture_options = { tolerance = true, pixels = true, connected = true }

local function fraction(options, name, standard)
    local value = options[name]
    if value == nil then return standard end
    if type(value) == "number" and value >= 0 and value <= 1 then return value end
    error("expect.picture: " .. name .. " must be a number from 0 to 1, got " .. show(value), 4)
end

local function pixel_count(options, name, standard)
    local value = options[name]
    if value == nil then return standard end
    if type(value) == "number" and value >= 0 and value < math.huge then return value end
    error("expect.picture: " .. name .. " must be a number of pixels, got " .. show(value), 4)
end

-- The comparison for the host, except the file. Called by the expectation itself, as the functions
-- below.
local function read_check(picture, golden, options)
    if type(picture) ~= "string" and type(picture) ~= "table" then
        misused("expect.picture: a file or the options of lissom.render are needed, got " .. show(picture), 1)
    end
    if type(golden) ~= "string" or not golden:find("%.png$") then
        misused("expect.picture: the golden picture must be the name of a .png file, got " .. show(golden), 1)
    end
    for key in pairs(options) do
        if not known_picture_options[key] then
            misused("expect.picture: no option " .. show(key) ..
                "; there are tolerance, pixels and connected", 1)
        end
    end
    return {
        golden = golden,
        tolerance = fraction(options, "tolerance", 0.05),
        pixels = fraction(options, "pixels", 0.0005),
        connected = pixel_count(options, "connected", 8),
    }
end

-- Draws into a file of the test: the file; or nil, and why this machine cannot.
local function draw(scene, golden)
    local render = rawget(require "lissom", "render")
    if not render then return nil, "this program draws no pictures" end
    local options = {}
    for key, value in pairs(scene) do options[key] = value end
    options.file = scene.file or host.folder() .. "/" .. golden:match("[^/\\]*$")
    local done, drawn = pcall(render, options)
    if done then return drawn end
    if drawn.code == "no_display" then return nil, drawn.message end
    if drawn.code == "invalid_argument" then
        require("lissom").error{ message = drawn.message, code = drawn.code, level = 4 }
    end
    return nil, "the picture could not be drawn: " .. drawn, true
end

-- The file to compare; or nil, why there is none, and whether this machine is the reason.
local function picture_file(picture, golden)
    if type(picture) == "table" then
        local file, message, is_wrong = draw(picture, golden)
        return file, message, not is_wrong
    end
    local reason = host.no_picture()
    if reason then return nil, reason, true end
    return picture
end

function expect.picture(picture, golden, options)
    local check = read_check(picture, golden, options or {})
    local file, reason, is_excused = picture_file(picture, golden)
    if not file and is_excused and not settings.require_pictures then
        host.report{ event = "left_out", text = reason }
        return
    end
    if not file and is_excused then reason = "LISSOM_REQUIRE_GL is set, but " .. reason end
    if not file then fail(reason) end
    check.picture = file
    local difference = host.picture(check)
    if difference then fail(difference) end
end

-- ---- test

-- The tests in the order they were declared, by their full names, and the groups around the declaration.
local tests, named, groups = {}, {}, {}
local running = false

local function place(level)
    local info = debug.getinfo(level + 1, "Sl")
    return info.currentline
end

local function check_declaration(what, name, body)
    if running then error(what .. " is called while a test runs; declare tests at the top of the file", 3) end
    if not is_text(name) then error(what .. ": a name is needed, got " .. show(name), 3) end
    if type(body) ~= "function" then error(what .. ": a function is needed, got " .. show(body), 3) end
end

local function full_name(name)
    local names = {}
    for i, group in ipairs(groups) do names[i] = group.name end
    names[#names + 1] = name
    return table.concat(names, " / ")
end

local function declare(_, name, body, options)
    check_declaration("test", name, body)
    local limit = settings.timeout
    for key, value in pairs(options or {}) do
        if key ~= "timeout" then error("test: no option " .. show(key) .. "; there is timeout", 2) end
        if type(value) ~= "number" or not (value > 0) then
            error("test: the timeout must be a number of seconds above 0, got " .. show(value), 2)
        end
        limit = value
    end
    local one = { name = full_name(name), body = body, line = place(2), limit = limit, groups = {} }
    for i, group in ipairs(groups) do one.groups[i] = group end
    if named[one.name] then
        error("test: " .. show(one.name) .. " was declared before, in line " .. named[one.name].line, 2)
    end
    named[one.name] = one
    tests[#tests + 1] = one
end

local whole_file = { before = {}, after = {} }
local test = {}

function test.group(name, body)
    check_declaration("test.group", name, body)
    groups[#groups + 1] = { name = name, before = {}, after = {} }
    body()
    groups[#groups] = nil
end

local function add_hook(kind, action)
    if running then error("test." .. kind .. " is called while a test runs", 3) end
    if type(action) ~= "function" then
        error("test." .. kind .. ": a function is needed, got " .. show(action), 3)
    end
    local hooks = (groups[#groups] or whole_file)[kind]
    hooks[#hooks + 1] = action
end

function test.before(action) add_hook("before", action) end
function test.after(action) add_hook("after", action) end

function test.skip(reason)
    if not is_text(reason) then error("test.skip: a reason is needed, got " .. show(reason), 2) end
    skip_reason = reason
    error("skipped: " .. reason, 2)
end

function test.folder()
    if not running then error("test.folder: there is one only while a test runs", 2) end
    return host.folder()
end

function test.file(name)
    if not running then error("test.file: there is one only while a test runs", 2) end
    if not is_text(name) then error("test.file: a name is needed, got " .. show(name), 2) end
    return host.folder() .. "/" .. name
end

strict("expect", expect)
strict("test", test)
getmetatable(test).__call = declare

-- ---- Running

local function is_chosen(one)
    local filter = settings.filter
    if not filter or one.name:find(filter, 1, true) then return true end
    local is_pattern, found = pcall(string.find, one.name, filter)
    return is_pattern and found
end

-- Returns the event of a failed call: { status =, message =, ... }.
local function verdict(failure)
    if skip_reason and failure.message:find("skipped: " .. skip_reason, 1, true) then
        return { status = "skipped", message = skip_reason }
    end
    failure.status = "failed"
    failure.expectation = failed_expectation ~= nil and
        failure.message:find(failed_expectation, 1, true) ~= nil
    if failure.code == "no_display" and not settings.require_pictures then
        return { status = "skipped", message = failure.message }
    end
    return failure
end

local function run_body(one)
    for _, action in ipairs(whole_file.before) do action() end
    for _, group in ipairs(one.groups) do
        for _, action in ipairs(group.before) do action() end
    end
    return one.body()
end

-- The hooks of the innermost group first, the last one declared first; all of them are called.
local function run_after(one)
    local first
    local function run(hooks)
        for i = #hooks, 1, -1 do first = host.call(hooks[i], one.limit) or first end
    end
    for i = #one.groups, 1, -1 do run(one.groups[i].after) end
    run(whole_file.after)
    return first
end

local function run_one(one)
    failed_expectation, skip_reason, running = nil, nil, true
    math.randomseed(settings.seed)
    host.report{ event = "begin", name = one.name, line = one.line }
    local failure = host.call(function() return run_body(one) end, one.limit)
    local ended = failure and verdict(failure)
    local later = run_after(one)
    if later and not (ended and ended.status == "failed") then ended = verdict(later) end
    ended = ended or { status = "passed" }
    ended.event, running = "end", false
    host.report(ended)
end

local function run_all()
    local count = 0
    for _, one in ipairs(tests) do
        if is_chosen(one) then
            count = count + 1
            if settings.list then
                host.report{ event = "test", name = one.name, line = one.line }
            elseif count > settings.finished then
                run_one(one)
            end
        end
    end
end

-- Runs the file that `load` loads, and the tests that it declares.
return { test = test, expect = expect, run = function(load)
    local failure = host.call(load, settings.timeout)
    local ended = failure and verdict(failure)
    if not ended and #tests == 0 then
        ended = { status = "failed",
            message = "the file declares no test: test(\"name\", function() ... end)" }
    end
    if ended then
        ended.event = "file"
        host.report(ended)
    else
        host.report{ event = "declared", count = #tests }
        run_all()
    end
    host.report{ event = "done" }
end }
