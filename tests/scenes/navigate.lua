-- The view turned by hand with a tool.
local hand = require "hand"
local lissom = require "lissom"

local h

test.before(function()
    h = hand.new("navigate", { box = lissom.shapes.box() }, { eye = { 0, 0, 10 }, fov = 30 })
end)

local function camera() return h.host.camera end

-- A drag by so many pixels, in as many events.
local function drag(right, down, events, options)
    local event = { x = 640, y = 480 }
    for key, value in pairs(options or {}) do event[key] = value end
    h.host:press(event)
    for i = 1, events do
        event.x, event.y = 640 + right * i / events, 480 + down * i / events
        h.host:move(event)
    end
    h.host:release(event)
end

test("a drag across the height of the picture turns by half a turn, however many events it has", function()
    drag(960, 0, 1)
    expect.near(camera():eye(), { 0, 0, -10 })
    drag(-960, 0, 7)
    expect.near(camera():eye(), { 0, 0, 10 })
    expect.equal(h:steps(), 0)
end)

test("with shift what is seen follows the cursor, with ctrl it comes nearer and stays under it", function()
    drag(100, -50, 3, { shift = true })
    local x, y = camera():project({ 0, 0, 0 }, { 1280, 960 })
    expect.near({ x, y }, { 740, 430 })
    drag(0, -150, 3, { ctrl = true })
    expect.near(camera():eye()[3], 5)
end)

test("the parameter says what a drag does by itself", function()
    h.host:set{ by = "zoom", doubling = 100 }
    drag(0, 100, 2)
    expect.near(camera():eye()[3], 20)
end)

test("keys look from the sides, frame, and take perspective away", function()
    h:key("2")
    expect.near(camera():forward(), { 0, 0, 1 })
    h:key("5")
    expect.near(camera():forward(), { 0, -1, 0 })
    h:key("1")
    local mesh = h.scene:get("box")
    mesh:set_region("selected", mesh:region{ box = { min = { 0.4, 0.4, -1 }, max = { 1, 1, 1 } } })
    h:key("f")
    expect.near(camera():target(), { 0.5, 0.5, 0 })
    h:key("F")
    expect.near(camera():target(), { 0, 0, 0 })
    h:key("o")
    expect.truthy(camera():ortho())
    h:key("o")
    expect.equal(camera():ortho(), nil)
    expect.equal(h:steps(), 1)          -- that something was selected
end)

test("an empty scene is looked at, too", function()
    h = hand.new("navigate", {})
    for _, key in ipairs{ "1", "f", "F", "o", "7" } do h:key(key) end
    expect.truthy(camera():eye())
end)

test("Escape in the middle of a drag brings the view back", function()
    h.host:press{ x = 640, y = 480 }
    h.host:move{ x = 900, y = 480 }
    expect.truthy(math.abs(camera():eye()[1]) > 1)
    h.host:cancel()
    expect.near(camera():eye(), { 0, 0, 10 })
    h.host:move{ x = 300, y = 480 }
    expect.near(camera():eye(), { 0, 0, 10 })
end)

test("what is done after the view was turned is repeated as it was seen", function()
    local seen_by = { eye = { 0, 0, 10 }, fov = 30, record = true }
    h = hand.new("navigate", { ball = lissom.shapes.sphere{} }, seen_by)
    drag(700, 90, 9)
    h:use("select")
    h.host:set{ by = "click" }:click{ x = 640, y = 480 }
    local seen = h.scene:get("ball"):region("selected"):vertices()
    local text = h.host:recording():gsub('require%("lissom"%)%.replay', "")
    local recorded = assert(load(text))()
    local fresh = lissom.scene{}
    fresh:add("ball", lissom.shapes.sphere{})
    fresh:clear_history()
    lissom.replay(recorded, { scene = fresh })
    expect.equal(fresh:get("ball"):region("selected"):vertices(), seen)
end)

test("only a tool that runs sets what is seen", function()
    local kept
    local tool = lissom.tool{ name = "keeps", press = function(_, ev) kept = ev end }
    h.host:use(tool):click{ x = 1, y = 1 }
    expect.error(function() kept:look(camera()) end, "a tool that runs")
    tool.press = function(_, ev) ev:look("front") end
    expect.error(function() h.host:click{ x = 1, y = 1 } end, "takes a camera")
    tool.press = function(_, ev) ev:look(ev.camera:orbit(1e300, 0 / 0)) end
    expect.error(function() h.host:click{ x = 1, y = 1 } end, "finite number")
end)
