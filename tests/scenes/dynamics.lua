-- Hair in motion while the button is down.
local hand = require "hand"
local lissom = require "lissom"

local head = lissom.shapes.head{ vertices = 3000 }
local hair, h

test.before(function()
    local style = lissom.hairstyle(head, { resolution = 4000 })
    for _, azimuth in ipairs{ -90, 90, 180 } do
        style:add_stream{ points = { style:at{ azimuth = azimuth, elevation = 70, lift = 0.01 },
            style:at{ azimuth = azimuth, elevation = 10, lift = 0.03 } } }
    end
    hair = style:grow{ count = 200, length = 0.2 }
    h = hand.new("navigate", { head = head, style = style, ["style hair"] = hair })
    h:use("dynamics")
end)

local function hair_place() return h.scene:info("head").transform end

local function press_and_turn(ticks)
    h.host:press{ x = 600, y = 400 }
    for i = 1, ticks do h.host:move{ x = 600 + 20 * i, y = 400 }:tick{ seconds = 1 / 30 } end
end

test("hair moves and the head turns while the button is down, and both are put back", function()
    local before, place = h.scene:hash(), hair_place()
    press_and_turn(6)
    local moving = h.scene:get("style hair in motion")
    expect.equal(#moving, #hair)
    expect.falsy(h.scene:info("style hair").visible)
    expect.truthy(moving:hash() ~= hair:hash())
    expect.truthy(math.abs(hair_place()[1][3] - place[1][3]) > 0.1)
    h.host:release{ x = 700, y = 400 }
    expect.equal(h.scene:hash(), before)
    expect.equal(h.host:undo(), nil)
end)

test("hair can be kept as it hangs, with all else that it has, and undo brings it back", function()
    local face = hair:root(1).face
    h.host:set{ keep = true }
    local before = h.scene:hash()
    press_and_turn(6)
    h.host:release{ x = 700, y = 400 }
    local kept = h.scene:get("style hair")
    expect.equal(#kept, 200)
    expect.equal(kept:root(1).face, face)
    expect.truthy(h.scene:hash() ~= before)
    expect.equal(h.host:undo(), "dynamics")
    expect.equal(h.scene:hash(), before)
end)

test("Escape puts everything back, and the next press begins anew", function()
    local before = h.scene:hash()
    press_and_turn(3)
    h.host:cancel()
    expect.equal(h.scene:hash(), before)
    press_and_turn(3)
    h.host:release{ x = 700, y = 400 }
    expect.equal(h.scene:hash(), before)
end)

test("a recording repeats the ticks", function()
    local recorded = hand.new("navigate", { head = head, ["some hair"] = hair }, { record = true })
    recorded:use("dynamics")
    recorded.host:set{ keep = true }
    recorded.host:press{ x = 600, y = 400 }:tick{ seconds = 0.1 }:tick{ seconds = 0.05 }
    recorded.host:release{ x = 600, y = 400 }
    expect.truthy(recorded.host:recording():find('"tick", 0.05', 1, true))
end)

test("ticks count in a gesture alone, and bad ones are refused", function()
    local before = h.scene:hash()
    h.host:tick{ seconds = 0.1 }
    expect.equal(h.scene:hash(), before)
    expect.error(function() h.host:tick{ seconds = -1 } end, "seconds")
    expect.error(function() h.host:tick{ time = 1 } end, "time")
end)

test("without hair or a head the tool says what to do", function()
    local bare = hand.new("dynamics", { head = head })
    expect.error(function() bare.host:press{ x = 600, y = 400 } end, "no hair is to be seen")
    local alone = hand.new("dynamics", { hair = hair })
    expect.error(function() alone.host:press{ x = 600, y = 400 } end, "no head")
end)

test("ties of a script hold hair, and bad ones are refused", function()
    local set = hair:guide_set{ count = 12 }
    local tip = set:guides():points()
    local x, y, z = tip:get(16)
    local function rig(ties) return set:dynamics{ ties = ties }:rig() end
    expect.equal(#rig{ { name = "clip", center = { x, y, z } } }.ties, 1)
    expect.truthy(#rig{ { center = { x, y, z }, radius = 0.5 } }.ties[1].points > 100)
    expect.error(function() rig{ {} } end, "center")
    expect.error(function() rig{ { center = { 9, 9, 9 } } } end, "holds no point")
end)
