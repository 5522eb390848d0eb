-- Hair of others that becomes a style.
local lissom = require "lissom"
local refit = require "refit"

local head = lissom.shapes.head{ vertices = 4000 }
local scalp = lissom.scalp(head)

-- Hair that falls to all sides, longer behind.
local function given()
    local style = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = 8000 })
    for azimuth = 0, 315, 45 do
        local points = {}
        for i, place in ipairs{ { 62, 0.008 }, { 35, 0.018 }, { 5, 0.02 }, { -25, 0.022 } } do
            points[i] = scalp:at{ azimuth = azimuth, elevation = place[1], lift = place[2] }
        end
        style:add_stream{ points = points }
    end
    return style:grow{ count = 1200, length = function(_, _, _, z) return z < 0 and 0.16 or 0.1 end }
end

-- The root mean square of distances between the points of two sets.
local function apart(a, b)
    local p, q, sum = a:points(), b:points(), 0
    for i = 1, #p do sum = sum + (p[i] - q[i]) ^ 2 / #p end
    return math.sqrt(3 * sum)
end

test("hair that lies on its head stays where it lies", function()
    local hair = given()
    local motion, height = refit.place(hair, scalp)
    expect.equal(motion.scale, 1)
    expect.truthy(height < 1e-4)
    expect.near(apart(refit.move(hair:copy(), motion), hair), 0, 1e-7)
end)

test("hair in another unit, with another axis up, turned and beside the head, is brought onto it", function()
    local hair = given()
    for _, case in ipairs{ { up = "y", turn = 0, scale = 100 }, { up = "z", turn = 90, scale = 39.37 },
        { up = "y", turn = 180, scale = 1000 } } do
        local moved = hair:copy()
        moved:transform{ rotate = { axis = "y", angle = -case.turn }, scale = case.scale }
        if case.up == "z" then moved:transform{ rotate = { axis = "x", angle = 90 } } end
        moved:transform{ translate = { 3 * case.scale, -case.scale, 2 * case.scale } }
        local motion, height = refit.place(moved, scalp)
        expect.equal(motion.up, case.up)
        expect.equal(motion.turn, case.turn)
        expect.near(motion.scale * case.scale, 1, 0.06)
        expect.truthy(height < 0.003)
        local off = apart(refit.move(moved, motion), hair)
        expect.truthy(off < 0.02, "off by " .. off)
    end
end)

test("millimetres on a head in metres are only a unit", function()
    local hair = given()
    local motion = refit.place(hair:copy():transform{ scale = 1000 }, scalp)
    expect.near(motion.scale, 0.001, 1e-12)
    expect.equal(motion.move[1], 0)
end)

test("a style of given hair flows as that does, as long, and is edited like one's own", function()
    local hair = given()
    local made = refit.style(hair, head, { guides = 60, resolution = 12000 })
    expect.truthy(made.angle < 8, "directions are off by " .. made.angle)
    expect.truthy(made.length < 0.12, "lengths are off by " .. made.length)
    expect.equal(#made.guides:guides(), 60)
    expect.equal(#made.style:curves(), 60)
    expect.truthy(#made.hair > 0.9 * #hair)
    -- Its text makes the same hair, and a curve that is switched off other hair.
    local again = lissom.read_style(made.style:text(), head, { scalp = made.style:scalp() })
    expect.equal(again:grow(made.grow):hash(), made.style:grow(made.grow):hash())
    made.style:curves()[1]:remove()
    expect.truthy(again:grow(made.grow):hash() ~= made.style:grow(made.grow):hash())
end)

test("hair grows where there was hair, and nowhere else", function()
    local hair = given()
    local left = hair:select{ where = function(_, x) return x > 0 end }
    local made = refit.style(left, head, { guides = 20, resolution = 8000 })
    local _, wrong = nil, 0
    for s = 1, #made.hair do
        if made.hair:root(s).position[1] < -0.012 then wrong = wrong + 1 end
    end
    expect.equal(wrong, 0)
end)

test("two strands and strands without length make no style", function()
    expect.error(function() refit.style(given():select{ first = 2 }, head) end, "at least three strands")
    local dots = lissom.strands{ points = { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0.1, 0 }, { 0, 0.1, 0 } },
        counts = { 2, 2 } }
    expect.error(function() refit.style(dots, head, { place = false }) end, "at least three strands")
end)
