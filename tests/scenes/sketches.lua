-- Whole hairstyles sketched by a hand with noise and uneven speed: few strokes and seconds, replayed to one
-- hash. With LISSOM_SKETCHES=FOLDER each is drawn there, too.
local artist = require "artist"
local hair = require "tools.support.hair"
local lissom = require "lissom"
local route_of = require("strokes").route
local strokes = require "strokes"

local by, to = strokes.by, strokes.to

-- The objects that a sketch begins with: a head with a style.
local function begin(volume)
    local head = lissom.shapes.head{ vertices = 10000 }
    return { head = head, style = lissom.hairstyle(head, { resolution = 20000, volume = volume }) }
end

-- An artist with a tool before such objects.
local function sketch(tool, seed, volume)
    local objects = begin(volume)
    local a = artist.new(tool, objects, { seed = seed })
    a:use(tool, { strands = 100 })
    a.route, a.volume = route_of(objects.style), volume
    return a, objects.style
end

-- How far curves are from the lines that they were drawn after, in metres: the root of the mean square.
local function off(style, curve, route)
    local sum, course = 0, curve:points()
    local scale = style:scalp():scale()
    local cut = {}
    for i = 2, #route do cut[#cut + 1] = route[i] end
    for _, point in ipairs(cut) do sum = sum + (hair.distance(course, point) / scale) ^ 2 end
    return math.sqrt(sum / #cut)
end

-- A tail: its spine from behind, then from another side, where its depth is right, and the ring of its tie.
local function tail(a, places, first, second, radius)
    local points, before = a.route(places), #a.style:curves()
    a:use("ponytail"):look(first[1], first[2], first[3], first[4]):stroke(points, { shift = before > 0 })
    local curve = a.style:curves()[before + 1]
    a:look(second[1], second[2], second[3], second[4])
    local seen, start = a:seen(points), a:seen{ curve:course()[1] }[1]
    while #seen > 3 and (seen[2][1] - start[1]) ^ 2 + (seen[2][2] - start[2]) ^ 2 < 400 do table.remove(seen, 2) end
    seen[1] = start
    a:pixels(seen)
    expect.equal(#a.style:curves(), before + 1)
    if radius then
        local pixels = radius * 960 / (second[3] or a.metres)
        a:ring(curve:points()[4], pixels, pixels)
        expect.near(curve:tie().radius, radius * a.style:scalp():scale(), 0.004)
    end
    expect.equal(#a.style:curves(), before + 1)
    return curve, off(a.style, curve, points)
end

-- Both profiles of a tail, so far from its spine at each share of it.
local function profiles(a, curve, widths)
    local list = a:seen(curve:course())
    for side = -1, 1, 2 do
        local line = {}
        for i, width in ipairs(widths) do
            local k = 2 + math.floor((i - 1) / (#widths - 1) * 0.85 * (#list - 3))
            local u, v = list[k + 1][1] - list[k][1], list[k + 1][2] - list[k][2]
            local long, pixels = math.sqrt(u * u + v * v), side * width * 960 / a.metres
            line[i] = { list[k][1] - pixels * v / long, list[k][2] + pixels * u / long }
        end
        a:pixels(line)
    end
    expect.truthy(#curve:profiles()[1] > 2 and #curve:profiles()[2] > 2)
end

-- A stream drawn as it is seen from one side, and again from another: { azimuth, elevation } each.
local function stream(a, places, first, second)
    local points = a.route(places)
    a:look(first[1], first[2])
    local before = #a.style:curves()
    a:stroke(points)
    expect.truthy(#a.style:curves() > before)
    if second then
        local curve = a.style:curves()[before + 1]
        a:look(second[1], second[2])
        local seen = a:seen(points)
        seen[1] = a:seen{ curve:course()[1] }[1]
        a:choose(curve)
        a:pixels(seen)
        a.host:click{ x = 5, y = 5 }
        expect.equal(#a.style:curves(), before + (a.hand.tool.params.symmetric and 2 or 1))
    end
    return off(a.style, a.style:curves()[before + 1], points)
end

test("an asymmetric bob: ten streams", function()
    local a = sketch("stream", 11)
    local worst = 0
    for _, one in ipairs{
        { { { -38, 44, 10 }, { -12, 49, 20 }, { 22, 45, 22 }, { 52, 33, 20 }, { 72, 8, 20 }, by(4, -50, -4),
            by(-4, -50, -4) }, { 15, 25 }, { 80, 5 } },
        { { { -30, 70, 12 }, { 30, 72, 18 }, { 66, 48, 20 }, { 84, 15, 22 }, by(6, -50, 0), by(-4, -50, 0) },
            { 60, 35 }, { 10, 10 } },
        { { { -52, 45, 8 }, { -70, 26, 14 }, { -79, 2, 18 }, by(-4, -50, -4), by(4, -20, -4) }, { -60, 10 },
            { 0, 5 } },
        { { { -80, 65, 10 }, { -88, 38, 18 }, { -92, 8, 22 }, by(-6, -40, 0), by(4, -20, 0) }, { -90, 15 },
            { -10, 5 } },
        { { { 120, 72, 12 }, { 106, 42, 20 }, { 108, 5, 22 }, by(6, -60, 2), by(-4, -60, 4) }, { 105, 15 },
            { 180, 5 } },
        { { { -125, 72, 12 }, { -108, 42, 20 }, { -110, 5, 22 }, by(-6, -40, 2), by(4, -20, 4) }, { -105, 15 },
            { 180, 5 } },
        { { { 155, 68, 10 }, { 140, 35, 20 }, { 137, -5, 22 }, { 140, -35, 22 }, by(0, -50, -2) }, { 150, 15 },
            { 90, 5 } },
        { { { -155, 68, 10 }, { -140, 35, 20 }, { -137, -5, 22 }, { -140, -30, 22 }, by(0, -20, -2) },
            { -150, 15 }, { -90, 5 } },
        { { { 175, 62, 8 }, { 172, 25, 20 }, { 172, -15, 22 }, by(0, -60, 6), by(0, -30, 4) }, { 170, 15 },
            { 90, 5 } },
    } do worst = math.max(worst, stream(a, table.unpack(one))) end
    expect.truthy(worst < 0.015, worst)
    a:use("stream", { cut = 0.1, slant = 20 })
    a.hair_length = 0.25
    a:done("asymmetric bob", begin())
end)

test("a centre parting with tilt strokes on both sides", function()
    local a = sketch("parting", 5)
    local places = { { 0, 38 }, { 0, 52 }, { 0, 66 }, { 0, 80 } }
    a:look(0, 50):stroke(a.route(places))
    for _, side in ipairs{ 1, -1 } do
        a:stroke(a.route{ { 14 * side, 42 }, { 24 * side, 44 }, { 38 * side, 44 } })
        a:stroke(a.route{ { 30 * side, 70 }, { 55 * side, 66 }, { 75 * side, 58 } })
    end
    local parting = a.style:curves()[1]
    expect.equal(#parting:hints(), 4)
    local tilt = parting:tilt()
    expect.near(tilt.left.start, tilt.right.start, 14)
    a:use("stream", { symmetric = true, strands = 100, cut = 0.13 })
    for _, one in ipairs{
        { { { 10, 48, 10 }, { 30, 40, 18 }, { 52, 30, 18 }, { 71, 8, 18 }, by(4, -50, -4), by(-4, -70, -4) },
            { 35, 20 }, { 0, 10 } },
        { { { 12, 74, 10 }, { 60, 62, 18 }, { 84, 32, 20 }, { 92, 5, 22 }, by(5, -50, 0), by(-4, -80, 0) },
            { 75, 30 }, { 0, 10 } },
        { { { 130, 68, 12 }, { 126, 32, 20 }, { 126, -5, 22 }, by(2, -50, 0), by(-2, -80, 0) }, { 130, 15 },
            { 180, 10 } },
        { { { 170, 62, 12 }, { 165, 32, 20 }, { 165, -5, 22 }, by(0, -60, 2), by(0, -70, 0) }, { 165, 15 },
            { 90, 10 } },
    } do stream(a, one[1], one[2]) end
    expect.equal(#a.style:curves(), 9)
    a.hair_length = 0.27
    a:done("centre parting", begin())
end)

test("a high ponytail with a drawn section and profiles", function()
    local volume = { min = { -0.16, -0.3, -0.3 }, max = { 0.16, 0.22, 0.15 } }
    local a = sketch("ponytail", 7, volume)
    a.metres = 0.6
    local places = { { 180, 52, 8 }, { 180, 51, 30 }, to(0, 118, -125), to(0, 80, -165), to(0, 20, -185),
        to(0, -60, -190), to(0, -140, -185) }
    local curve, error = tail(a, places, { 180, 10 }, { 90, 5 }, 0.017)
    expect.truthy(error < 0.01, error)
    profiles(a, curve, { 0.022, 0.034, 0.04, 0.036, 0.02 })
    a:use("stream", { symmetric = true, stop = false, strands = 100, length = 0.6 })
    for _, one in ipairs{
        { { { 12, 40, 4 }, { 40, 62, 7 }, { 120, 72, 9 }, { 172, 58, 14 } }, { 60, 45 } },
        { { { 62, 14, 4 }, { 92, 34, 7 }, { 130, 48, 9 }, { 168, 50, 14 } }, { 95, 20 } },
        { { { 125, -10, 4 }, { 140, 12, 7 }, { 158, 32, 9 }, { 172, 44, 14 } }, { 140, 15 } },
        { { { 172, -38, 4 }, { 172, -5, 7 }, { 174, 22, 9 }, { 177, 40, 14 } }, { 180, 10 } },
    } do stream(a, one[1], one[2]) end
    a.hair_length, a.high, a.low = 0.6, 0.62, -0.02
    a:done("high ponytail", begin(volume))
end)

test("two tails", function()
    local volume = { min = { -0.3, -0.32, -0.2 }, max = { 0.3, 0.2, 0.16 } }
    local a = sketch("ponytail", 9, volume)
    a.metres = 0.6
    for _, side in ipairs{ 1, -1 } do
        local places = { { 118 * side, 14, 8 }, { 118 * side, 15, 30 }, to(135 * side, 28, -70),
            to(160 * side, -20, -84), to(170 * side, -90, -88), to(172 * side, -180, -88) }
        tail(a, places, { 90 * side, 5 }, { 180, 5 }, 0.016)
    end
    a:use("parting", { strands = 100 })
    a:look(0, 60):stroke(a.route{ { 0, 40 }, { 0, 60 }, { 0, 80 } })
    a:look(180, 50):stroke(a.route{ { 0, 88 }, { 180, 70 }, { 180, 40 }, { 180, 5 } }, { shift = true })
    a:use("stream", { symmetric = true, stop = false, strands = 100, length = 0.6 })
    for _, one in ipairs{
        { { { 10, 40, 4 }, { 32, 50, 8 }, { 72, 44, 9 }, { 98, 28, 10 }, { 113, 16, 18 } }, { 60, 30 } },
        { { { 168, -30, 4 }, { 163, -8, 7 }, { 145, 8, 10 }, { 125, 14, 18 } }, { 150, 10 } },
        { { { 168, 66, 4 }, { 150, 50, 8 }, { 130, 28, 10 }, { 122, 18, 18 } }, { 140, 35 } },
    } do stream(a, one[1], one[2]) end
    a.hair_length, a.high, a.low = 0.5, 0.62, -0.05
    a:done("two tails", begin(volume))
end)

test("a pony with fringe", function()
    local volume = { min = { -0.16, -0.3, -0.3 }, max = { 0.16, 0.22, 0.17 } }
    local a = sketch("ponytail", 13, volume)
    a.metres = 0.6
    local places = { { 180, 26, 8 }, { 180, 27, 30 }, to(0, 55, -150), to(0, 0, -170), to(0, -70, -180),
        to(0, -150, -182) }
    tail(a, places, { 180, 5 }, { 90, 5 }, 0.017)
    a:use("stream", { symmetric = true, stop = false, strands = 100, length = 0.5 })
    for _, one in ipairs{
        { { { 48, 36, 4 }, { 80, 44, 8 }, { 130, 44, 9 }, { 168, 32, 14 } }, { 95, 30 } },
        { { { 64, 12, 4 }, { 96, 26, 8 }, { 140, 28, 9 }, { 168, 26, 14 } }, { 100, 15 } },
        { { { 20, 72, 4 }, { 120, 76, 8 }, { 172, 50, 10 }, { 178, 34, 14 } }, { 140, 50 } },
        { { { 160, -36, 4 }, { 165, -8, 7 }, { 172, 12, 10 }, { 177, 22, 14 } }, { 170, 10 } },
    } do stream(a, one[1], one[2]) end
    a:use("stream", { stop = true })
    for _, one in ipairs{
        { { { 6, 62, 8 }, { 7, 46, 16 }, { 8, 30, 14 }, { 9, 18, 12 } }, { 0, 20 } },
        { { { 26, 58, 8 }, { 27, 44, 16 }, { 27, 30, 14 }, { 26, 16, 12 } }, { 15, 20 } },
        { { { 44, 52, 8 }, { 46, 38, 16 }, { 46, 26, 14 }, { 44, 10, 12 } }, { 35, 20 } },
    } do stream(a, one[1], one[2]) end
    a:use("parting", { strands = 100, height = 0, gap = 0 })
    a:look(0, 70):stroke(a.route{ { -58, 42 }, { -35, 62 }, { 0, 68 }, { 35, 62 }, { 58, 42 } })
    a.hair_length, a.high, a.low = 0.5, 0.62, -0.05
    a:done("pony with fringe", begin(volume))
end)
