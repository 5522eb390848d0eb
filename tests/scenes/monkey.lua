-- A monkey at all tools: whatever it does, the scene stays whole, and undo leads back to the beginning.
local hand = require "hand"
local lissom = require "lissom"

local trials = tonumber(os.getenv("LISSOM_TRIALS") or "") or 1
local tools = { "select", "deform", "cut", "merge", "transform", "measure", "smooth", "line" }
local keys = { "enter", "escape", "backspace", "delete", "tab", "p", "f", "w", "e", "r", "x", "y", "z", "+",
    "-", "i", "a", "d", "h", "1", "2", "5", ".", "0" }

local function objects()
    local ball = lissom.shapes.sphere{ kind = "triangles", segments = 8 }
    local cup = ball:cut{ plane = { point = { 0, 0.1, 0 }, normal = { 0, -1, 0 } } }
    return {
        bar = lissom.shapes.bar{ across = 2, along = 8 }:transform{ translate = { -2, 0, 0 } },
        cup = cup,
        lid = cup:copy():transform{
            rotate = { axis = "x", angle = 180 }, scale = 1.2, translate = { 0, 2, 0 },
        },
        sheet = lissom.shapes.grid{ size = { 2, 2 }, segments = { 8, 8 } }
            :transform{ rotate = { axis = "x", angle = 70 } },
    }
end

local function pick(list) return #list > 0 and list[math.random(#list)] or nil end

-- Mostly a place that something is seen at.
local function place(h)
    local names = h.scene:names()
    local name = pick(names)
    if not name or math.random() < 0.2 then return { x = math.random(1280), y = math.random(960) } end
    local object, kind = h.scene:get(name), h.scene:info(name).kind
    if kind == "deformation" then object, kind = object:mesh(), "mesh" end
    local point = kind == "mesh" and { object:position(math.random(#object)) } or pick(object:points())
    local x, y = h.camera:project(point, h.host.size)
    return { x = x, y = y }
end

local function with_modifiers(event)
    event.shift, event.ctrl = math.random() < 0.2, math.random() < 0.2
    return event
end

-- Sets a parameter of the tool to anything that it may have.
local function set(h)
    local p = pick(h.tool.params:schema())
    local value
    if p.type == "choice" then
        value = pick(p.choices)
    elseif p.type == "boolean" then
        value = math.random() < 0.5
    elseif p.type == "integer" then
        value = math.random(p.min, math.min(p.max, p.min + 5))
    else
        value = math.random() < 0.5 and p.default or p.min + (p.max - p.min) * math.random() ^ 3
    end
    h.host:set{ [p.name] = value }
end

local deeds = {
    { 30, function(h)
        h.host:press(with_modifiers(place(h)))
        for _ = 1, math.random(0, 4) do h.host:move(with_modifiers(place(h))) end
        h.host:release(place(h))
    end },
    { 10, function(h)       -- something comes in between
        h.host:press(place(h))
        h.host:move(place(h))
        local interrupt = math.random(5)
        if interrupt == 1 then h.host:cancel() end
        if interrupt == 2 then h.host:undo() end
        if interrupt == 3 then h:use(pick(tools)) end
        if interrupt == 4 then h:key(pick(keys)) end
        if interrupt == 5 and #h.scene > 1 and not h.host.log then h.scene:remove(pick(h.scene:names())) end
        h.host:move(place(h))
        h.host:release(place(h))
    end },
    { 30, function(h) h:key(pick(keys)) end },
    { 10, function(h) h.host:move(place(h)) end },
    { 8, function(h) h:use(pick(tools)) end },
    { 8, set },
    { 5, function(h) h.host:undo() end },
    { 5, function(h) h.host:redo() end },
    { 1, function(h)
        local name = pick(h.scene:names())
        if name then h.scene:step("remove", function() h.scene:remove(name) end) end
    end },
    { 1, function(h)
        local name = pick(h.scene:names())
        if name and h.scene:info(name).kind == "mesh" then
            h.scene:step("triangulate", function() h.scene:get(name):triangulate() end)
        end
    end },
}

-- One of them, as often as its number says; where it is recorded what a hand does, only of that.
local function deed(recorded)
    local count = recorded and #deeds - 2 or #deeds
    local sum = 0
    for i = 1, count do sum = sum + deeds[i][1] end
    local at = math.random() * sum
    for i = 1, count do
        at = at - deeds[i][1]
        if at <= 0 then return deeds[i][2] end
    end
    return deeds[1][2]
end

-- An error of a tool says what to do; one in its own doing is Lua's or that of a wrong call.
local function is_told(message)
    for _, wrong in ipairs{ "attempt to", "no method", "no field", "expected", "unknown option" } do
        if message:find(wrong, 1, true) then return false end
    end
    return true
end

local function play(count, recorded)
    local h = hand.new(pick(tools), objects(), { record = recorded })
    local first = h.scene:hash()
    for _ = 1, count do
        local act = deed(recorded)
        local before = h.scene:history().place
        local done, message = pcall(act, h)
        if not done then
            expect.truthy(is_told(tostring(message)), tostring(message))
            if h.host.held then h.host:cancel() end
        end
        expect.equal(h.scene:depth(), 0)
        expect.truthy(h.scene:history().place <= before + 2)
        h.host:draw()
    end
    h.host:use(nil)
    local last, steps = h.scene:hash(), h:steps()
    for _ = 1, steps do h.scene:undo() end
    expect.equal(h.scene:hash(), first)
    for _ = 1, steps do h.scene:redo() end
    expect.equal(h.scene:hash(), last)
    return h
end

for trial = 1, 3 * trials do
    test("a monkey " .. trial, function()
        math.randomseed(trial)
        play(120)
    end)
    test("a monkey whose doings are recorded and done again " .. trial, function()
        math.randomseed(trial)
        local h = play(60, true)
        local file = test.file("recording.lua")
        local stream = assert(io.open(file, "w"))
        stream:write(h.host:recording())
        stream:close()
        local fresh = hand.new("select", objects())
        lissom.replay(file, { scene = fresh.scene })
        expect.equal(fresh.scene:hash(), h.scene:hash())
    end)
end
