-- A monkey at the tools of hair: whatever it does, the scene stays whole, undo leads back to the beginning,
-- and what is recorded is done again.
local hand = require "hand"
local lissom = require "lissom"

local tools = { "stream", "parting", "ponytail", "comb", "mask" }
local keys = { "escape", "backspace", "delete", "tab", "enter", "x" }
local head = lissom.shapes.head{ vertices = 3000 }
local scalp = lissom.scalp(head)

local function objects()
    return { head = head, style = lissom.hairstyle(head, { scalp = scalp, resolution = 4000 }) }
end

local function pick(list) return list[math.random(#list)] end

-- A stroke over the picture that wanders from anywhere near the head.
local function stroke(h)
    local x, y, turn = math.random(440, 840), math.random(180, 700), math.random() * 6.3
    local bend, options = 0.3 * (math.random() - 0.5), { shift = math.random() < 0.2 }
    local function event() return { x = x, y = y, shift = options.shift } end
    h.host:press(event())
    for _ = 1, math.random(0, 30) do
        x, y, turn = x + 12 * math.cos(turn), y + 12 * math.sin(turn), turn + bend
        h.host:move(event())
    end
    if math.random() < 0.1 then h.host:undo() end
    h.host:release(event())
end

local function set(h)
    local p = pick(h.tool.params:schema())
    if p.name == "strands" then return end
    local value
    if p.type == "boolean" then
        value = math.random() < 0.5
    elseif p.choices then
        value = pick(p.choices)
    else
        value = p.min + (p.max - p.min) * math.random()
    end
    h.host:set{ [p.name] = value }
end

local deeds = { stroke, stroke, stroke, stroke, set, function(h) h:key(pick(keys)) end,
    function(h) h:use(pick(tools)).host:set{ strands = 50 } end, function(h) h.host:undo() end,
    function(h) h.host:redo() end }

local function is_told(message)
    for _, wrong in ipairs{ "attempt to", "no method", "no field", "expected", "unknown option" } do
        if message:find(wrong, 1, true) then return false end
    end
    return true
end

local function play(count, turn)
    local a = math.rad(turn)
    local h = hand.new(pick(tools), objects(), { record = true, ortho = 0.36,
        eye = { math.sin(a), 0.4, math.cos(a) }, target = { 0, 0, 0 } })
    h.host:set{ strands = 50 }
    local first = h.scene:hash()
    for _ = 1, count do
        local done, message = pcall(pick(deeds), h)
        if not done then
            expect.truthy(is_told(tostring(message)), tostring(message))
            if h.host.held then h.host:cancel() end
        end
        expect.equal(h.scene:depth(), 0)
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

for trial = 1, 4 * (tonumber(os.getenv("LISSOM_TRIALS") or "") or 1) do
    test("a monkey at the tools of hair " .. trial, function()
        math.randomseed(trial)
        local h = play(50, 360 * math.random())
        local file = test.file("recording.lua")
        local stream = assert(io.open(file, "w"))
        stream:write(h.host:recording())
        stream:close()
        local fresh = hand.new("select", objects())
        lissom.replay(file, { scene = fresh.scene })
        expect.equal(fresh.scene:hash(), h.scene:hash())
        -- The journal ends with a check of the hash.
        local other = hand.new("select", objects())
        assert(load(h.host:journal_text(), "=journal"))(other.scene)
    end)
end
