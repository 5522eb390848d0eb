-- Lines of a shape drawn anew by hand.
local hand = require "hand"
local lissom = require "lissom"

local h, ball

local function begin(mesh, options)
    ball = mesh or lissom.shapes.sphere{ kind = "triangles", segments = 24 }
    h = hand.new("redraw", { ball = ball }, options)
end

test.before(function() begin() end)

-- Points of an arc of the ball's outline, from -45 to 45 degrees about the top, raised by a hump.
local function arc(height, shift)
    local list = {}
    for i = 0, 12 do
        local angle = math.rad(-45 + 90 * i / 12)
        local r = 1 + (shift or 0) + height * math.cos(math.rad(2 * (-45 + 90 * i / 12)))
        list[i + 1] = { r * math.sin(angle), r * math.cos(angle), 0 }
    end
    return list
end

local function reversed(list)
    local other = {}
    for i = 1, #list do other[i] = list[#list + 1 - i] end
    return other
end

local function is_seen(x, y)
    return ball:pick({ x, y, 50 }, { 0, 0, -1 }) ~= nil
end

test("an outline drawn anew becomes the outline, in one step", function()
    local before = h.scene:hash()
    h:drag(arc(0), nil, 2)
    expect.equal(h:steps(), 0)
    expect.truthy(#h.host:draw().outlines == 1)
    h:drag(arc(0.3), nil, 2)
    expect.equal(h:steps(), 1)
    expect.truthy(is_seen(0, 1.26))
    expect.falsy(is_seen(0, 1.34))
    expect.near(ball:bounds().min[2], -1, 1e-9)
    expect.equal(h:there_and_back(), before)
    expect.truthy(ball:bounds().max[2] > 1.25)
end)

test("beside the outline by some pixels, either way round, the result is the same", function()
    local heights = {}
    for i, lines in ipairs{ { arc(0), arc(0.2) }, { arc(0, 0.06), arc(0.2) },
        { arc(0, -0.06), reversed(arc(0.2)) }, { reversed(arc(0)), arc(0.2) } } do
        begin()
        h:drag(lines[1], nil, 2)
        h:drag(lines[2], nil, 2)
        heights[i] = ball:bounds().max[2]
    end
    for i = 1, 4 do expect.near(heights[i], 1.2, 0.03) end
end)

test("a line across the middle moves at its depth", function()
    h:drag({ { -0.5, 0, 0 }, { 0.5, 0, 0 } }, nil, 12)
    h:drag({ { -0.5, 0, 0 }, { 0, 0.3, 0 }, { 0.5, 0, 0 } }, nil, 8)
    expect.equal(h:steps(), 1)
    expect.near(ball:bounds().max[3], 1, 0.08)
    expect.truthy(ball:bounds().min[3] < -0.9)
end)

test("a stroke beside the shape, and one that is too short, are refused", function()
    local before = h.scene:hash()
    expect.error(function() h:drag{ { 3, 3, 0 }, { 4, 3, 0 } } end, "draw along a line")
    h:drag(arc(0), nil, 2)
    h:click{ 0, 0, 0 }
    expect.equal(#h.host:draw().outlines, 0)
    expect.equal(h.scene:hash(), before)
end)

test("Escape and undo in the middle, and the mesh's end", function()
    local before = h.scene:hash()
    for _, interrupt in ipairs{ function() h.host:cancel() end, function() h.host:undo() end,
        function() h.scene:remove("ball") end } do
        h:drag(arc(0), nil, 2)
        local new = arc(0.3)
        h:press(new[1])
        for i = 2, 8 do h:move(new[i]) end
        interrupt()
        h:release(new[13])
        while h:steps() > 0 do h.host:undo() end
        expect.equal(h.scene:hash(), before)
        h.host:draw()
        h.host:cancel()
    end
end)

test("turned, far away and large", function()
    local place = { { 0, -100, 0, 1e4 }, { 100, 0, 0, -1e4 }, { 0, 0, 100, 2e4 }, { 0, 0, 0, 1 } }
    begin(nil, { places = { ball = place }, eye = { 1e4, -1e4, 3e4 }, target = { 1e4, -1e4, 2e4 },
        ortho = 960 })
    local function there(list)
        local moved = {}
        for i, p in ipairs(list) do moved[i] = { 1e4 + 100 * p[1], -1e4 + 100 * p[2], 2e4 + 100 * p[3] } end
        return moved
    end
    h:drag(there(arc(0)), nil, 2)
    h:drag(there(arc(0.3)), nil, 2)
    expect.near(ball:bounds().max[1], 1.3, 0.04)          -- up is the ball's own x
end)
