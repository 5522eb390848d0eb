-- Whole hairstyles sketched by a hand with noise and uneven speed: few strokes and seconds, replayed to one
-- hash. With LISSOM_SKETCHES=FOLDER each is drawn there, too.
local artist = require "artist"
local hair = require "tools.support.hair"
local lissom = require "lissom"
local route_of = require("strokes").route
local strokes = require "strokes"

local by, to = strokes.by, strokes.to

local resolution = os.getenv("LISSOM_SKETCHES") and 60000 or 20000

-- The objects that a sketch begins with: a head with a style.
local function begin(volume)
    local head = lissom.shapes.head{ vertices = 10000 }
    return { head = head, style = lissom.hairstyle(head, { resolution = resolution, volume = volume }) }
end

-- An artist with a tool before such objects.
local function sketch(tool, seed, volume)
    local objects = begin(volume)
    local a = artist.new(tool, objects, { seed = seed })
    a:use(tool, { strands = 100 })
    a.route, a.volume = route_of(objects.style), volume
    return a, objects.style
end

-- A tail: its spine from behind, then from another side, where its depth is right, and the ring of its tie.
local function tail(a, places, first, second, radius)
    local points, before = a.route(places), #a.style:curves()
    a:use("ponytail"):look(first[1], first[2], first[3], first[4]):stroke(points, { shift = before > 0 })
    local curve = a.style:curves()[before + 1]
    a:look(second[1], second[2], second[3], second[4])
    local seen, start = a:seen(points), a:seen{ curve:course()[1] }[1]
    while #seen > 3 and (seen[2][1] - start[1]) ^ 2 + (seen[2][2] - start[2]) ^ 2 < 400 do
        table.remove(seen, 2)
    end
    seen[1] = start
    a:pixels(seen)
    expect.equal(#a.style:curves(), before + (a.hand.tool.params.symmetric and 2 or 1))
    if radius then
        local pixels = radius * 960 / (second[3] or a.metres)
        a:ring(curve:points()[4], pixels, pixels)
        expect.near(curve:tie().radius, radius * a.style:scalp():scale(), 0.004)
    end
    expect.equal(#a.style:curves(), before + (a.hand.tool.params.symmetric and 2 or 1))
    return curve, a:off(curve, points)
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

test("an asymmetric bob: ten streams", function()
    local a = sketch("stream", 11)
    local worst = 0
    for _, one in ipairs{
        { { { -38, 44, 10 }, { -12, 49, 20 }, { 22, 45, 22 }, { 52, 33, 20 }, { 72, 8, 20 }, by(4, -50, -4),
            by(-4, -50, -4) }, { 15, 25 }, { 80, 5, 4 } },
        { { { -30, 70, 12 }, { 30, 72, 18 }, { 66, 48, 20 }, { 84, 15, 22 }, by(6, -50, 0), by(-4, -50, 0) },
            { 60, 35 }, { 10, 10 } },
        { { { -58, 42, 8 }, { -70, 26, 14 }, { -79, 2, 18 }, by(-4, -50, -4), by(4, -20, -4) }, { -60, 10 },
            { 0, 5 } },
        { { { -80, 65, 10 }, { -88, 38, 18 }, { -92, 8, 22 }, by(-6, -40, 0), by(4, -20, 0) }, { -90, 15 },
            { -10, 5 } },
        { { { 120, 72, 12 }, { 106, 42, 20 }, { 108, 5, 22 }, by(6, -60, 2), by(-4, -60, 4) }, { 105, 15 },
            { 180, 5 } },
        { { { -125, 72, 12 }, { -108, 42, 20 }, { -110, 5, 22 }, by(-6, -40, 2), by(4, -20, 4) }, {
            -105, 15 },
            { 180, 5 } },
        { { { 155, 68, 10 }, { 140, 35, 20 }, { 137, -5, 22 }, { 140, -35, 22 }, by(0, -50, -2) }, {
            150, 15 },
            { 90, 5 } },
        { { { -155, 68, 10 }, { -140, 35, 20 }, { -137, -5, 22 }, { -140, -30, 22 }, by(0, -20, -2) },
            { -150, 15 }, { -90, 5 } },
        { { { 175, 62, 8 }, { 172, 25, 20 }, { 172, -15, 22 }, by(0, -60, 6), by(0, -30, 4) }, { 170, 15 },
            { 90, 5 } },
    } do worst = math.max(worst, (a:stream(table.unpack(one)))) end
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
    } do a:stream(one[1], one[2], one[3]) end
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
    } do a:stream(one[1], one[2]) end
    a.hair_length, a.high, a.low = 0.6, 0.62, -0.02
    a:done("high ponytail", begin(volume))
end)

test("two tails", function()
    local volume = { min = { -0.3, -0.32, -0.2 }, max = { 0.3, 0.2, 0.16 } }
    local a = sketch("ponytail", 9, volume)
    a:use("ponytail", { fullness = 1.1, symmetric = true })
    a.metres = 0.6
    local places = { { 118, 14, 8 }, { 118, 15, 30 }, to(135, 28, -70), to(160, -20, -84),
        to(170, -90, -88), to(172, -180, -88) }
    tail(a, places, { 90, 5 }, { 180, 5 }, 0.02)
    a:key("g")
    a:use("parting", { strands = 100 })
    a:look(0, 60):stroke(a.route{ { 0, 40 }, { 0, 60 }, { 0, 80 } })
    a:look(180, 50):stroke(a.route{ { 0, 88 }, { 180, 70 }, { 180, 40 }, { 180, 5 } }, { shift = true })
    a:use("stream", { symmetric = true, stop = false, strands = 100, length = 0.6 })
    for _, one in ipairs{
        { { { 10, 40, 4 }, { 32, 50, 8 }, { 72, 44, 9 }, { 98, 28, 10 }, { 113, 16, 18 } }, { 60, 30 } },
        { { { 168, -30, 4 }, { 163, -8, 7 }, { 145, 8, 10 }, { 125, 14, 18 } }, { 150, 10 } },
        { { { 168, 66, 4 }, { 150, 50, 8 }, { 130, 28, 10 }, { 122, 18, 18 } }, { 140, 35 } },
    } do a:stream(one[1], one[2]) end
    a.hair_length, a.high, a.low = 0.5, 0.62, -0.05
    a:done("two tails", begin(volume))
end)

test("a pony with fringe", function()
    local volume = { min = { -0.16, -0.3, -0.3 }, max = { 0.16, 0.22, 0.17 } }
    local a = sketch("ponytail", 13, volume)
    a.metres = 0.6
    local places = { { 180, 26, 8 }, { 180, 27, 30 }, to(0, 55, -150), to(0, 0, -170), to(0, -70, -180),
        to(0, -150, -182) }
    tail(a, places, { 180, 5 }, { 90, 5 }, 0.019)
    a:key("g")
    a:use("stream", { symmetric = true, stop = false, strands = 100, length = 0.5 })
    for _, one in ipairs{
        { { { 48, 36, 4 }, { 80, 44, 8 }, { 130, 44, 9 }, { 168, 32, 14 } }, { 95, 30 } },
        { { { 64, 12, 4 }, { 96, 26, 8 }, { 140, 28, 9 }, { 168, 26, 14 } }, { 100, 15 } },
        { { { 20, 72, 4 }, { 120, 76, 8 }, { 172, 50, 10 }, { 178, 34, 14 } }, { 140, 50 } },
        { { { 160, -36, 4 }, { 165, -8, 7 }, { 172, 12, 10 }, { 177, 22, 14 } }, { 170, 10 } },
    } do a:stream(one[1], one[2]) end
    a:use("stream", { stop = true })
    for _, one in ipairs{
        { { { 6, 62, 8 }, { 7, 46, 16 }, { 8, 30, 14 }, { 9, 18, 12 } }, { 0, 20 } },
        { { { 26, 58, 8 }, { 27, 44, 16 }, { 27, 30, 14 }, { 26, 16, 12 } }, { 15, 20 } },
        { { { 44, 52, 8 }, { 46, 38, 16 }, { 46, 26, 14 }, { 44, 10, 12 } }, { 35, 20 } },
    } do a:stream(one[1], one[2]) end
    a:use("parting", { strands = 100, height = 0, gap = 0 })
    a:look(0, 70):stroke(a.route{ { -58, 42 }, { -35, 62 }, { 0, 68 }, { 35, 62 }, { 58, 42 } })
    a.hair_length, a.high, a.low = 0.5, 0.62, -0.05
    a:done("pony with fringe", begin(volume))
end)

test("long hair, half of it up: ten streams and more, partings on both sides, a tail", function()
    local volume = { min = { -0.2, -0.42, -0.24 }, max = { 0.2, 0.2, 0.16 } }
    local a = sketch("stream", 17, volume)
    a:use("stream", { symmetric = true })
    a.metres = 0.62
    local function low(places, first, second)
        a:look(first[1], first[2], nil, -0.1)
        local before, points = #a.style:curves(), a.route(places)
        a:stroke(points)
        if second then
            local curve = a.style:curves()[before + 1]
            a:look(second[1], second[2], nil, -0.1)
            local seen = a:seen(points)
            seen[1] = a:seen{ curve:course()[1] }[1]
            a:choose(curve):pixels(seen)
            a.host:click{ x = 5, y = 5 }
        end
        expect.equal(#a.style:curves(), before + (a.hand.tool.params.symmetric and 2 or 1))
    end
    low({ { 20, 37, 4 }, { 46, 28, 14 }, { 66, 6, 18 }, to(86, -60, 22), to(80, -115, -20), to(76, -170, -80),
        to(72, -220, -106), to(70, -360, -110) }, { 40, 10 }, { 110, 5 })
    low({ { 84, 22, 10 }, { 92, 4, 20 }, to(92, -60, -18), to(76, -120, -58), to(66, -190, -104),
        to(62, -360, -112) }, { 90, 10 }, { 180, 5 })
    low({ { 124, 20, 8 }, { 122, -5, 20 }, to(70, -80, -66), to(54, -130, -84), to(46, -190, -108),
        to(44, -360, -114) }, { 150, 5 }, { 90, 5 })
    low({ { 156, 2, 8 }, { 154, -28, 18 }, to(34, -130, -88), to(30, -200, -108), to(28, -360, -114) },
        { 180, 5 }, { 90, 5 })
    a:use("ponytail", { strands = 100, symmetric = false })
    tail(a, { { 180, 26, 8 }, { 180, 27, 30 }, to(0, 55, -140), to(0, 10, -158), to(0, -60, -166),
        to(0, -150, -170) }, { 180, 10 }, { 90, 5 }, 0.02)
    a:use("stream", { symmetric = true, stop = false, lift = 6 })
    low({ { 20, 54, 5 }, { 66, 58, 7 }, { 122, 48, 8 }, { 170, 33, 14 } }, { 80, 45 })
    low({ { 30, 70, 6 }, { 120, 68, 8 }, { 172, 40, 10 }, { 178, 30, 14 } }, { 120, 50 })
    low({ { 75, 44, 6 }, { 130, 44, 8 }, { 168, 30, 14 } }, { 120, 30 })
    low({ { 115, 35, 6 }, { 148, 32, 8 }, { 170, 27, 14 } }, { 150, 20 })
    a:use("parting", { strands = 100 })
    a:look(0, 50):stroke(a.route{ { 0, 38 }, { 0, 52 }, { 0, 66 } })
    a:use("parting", { height = 0, gap = 0 })
    for _, side in ipairs{ 1, -1 } do
        a:look(90 * side, 30)
        a:stroke(a.route{ { 47 * side, 41 }, { 62 * side, 34 }, { 88 * side, 34 }, { 116 * side, 28 },
            { 138 * side, 21 } }, { shift = true })
        a:stroke(a.route{ { 70 * side, 42 }, { 92 * side, 44 }, { 112 * side, 42 } })
        a:stroke(a.route{ { 78 * side, 30 }, { 88 * side, 22 }, { 98 * side, 8 } })
    end
    a:look(180, 15):stroke(a.route{ { 142, 20 }, { 180, 15 }, { -142, 20 } }, { shift = true })
    a:use("ponytail", { length = 0.46, cut = 0.34 })
    expect.truthy(a.strokes < 30)
    a.hair_length, a.high, a.low = 0.46, 0.66, -0.1
    a:done("long, half up", begin(volume))
end)

-- Figure 4.3: a stream, and what hint strokes do to it.
local function length(points)
    local sum = 0
    for i = 2, #points do sum = sum + hair.distance({ points[i], points[i] }, points[i - 1]) end
    return sum
end

local function middle(list, share) return list[math.floor(1.5 + share * (#list - 1))] end

test("cut, concatenation and insertion, on both supporting surfaces", function()
    local a = sketch("stream", 19)
    a:look(60, 15):stroke(a.route{ { 30, 55, 6 }, { 62, 40, 18 }, { 78, 5, 20 }, by(4, -60, 0), by(0,
        -60, -4) })
    local curve = a.style:curves()[1]
    for i, view in ipairs{ { 60, 15 }, { 125, 10 } } do
        a:look(view[1], view[2]):choose(curve)
        local whole, list = length(curve:points()), a:seen(curve:points())
        local p = middle(list, 0.7)
        a:pixels{ { p[1] - 70, p[2] - 10 }, { p[1] + 65, p[2] + 14 } }
        local cut = length(curve:points())
        expect.truthy(cut < 0.85 * whole and cut > 0.5 * whole, cut / whole)
        local tip = a:seen{ curve:points()[#curve:points()] }[1]
        a:pixels{ tip, { tip[1] + 12, tip[2] + 70 }, { tip[1] + 60, tip[2] + 150 } }
        expect.truthy(length(curve:points()) > 1.2 * cut)
        list = a:seen(curve:points())
        local from, other = middle(list, 0.35), middle(list, 0.75)
        local bow = { (from[1] + other[1]) / 2 + 55, (from[2] + other[2]) / 2 }
        local before = length(curve:points())
        a:pixels{ from, bow, other }
        expect.truthy(length(curve:points()) > before)
        expect.equal(#a.style:curves(), 1)
        if i == 1 then a.host:set{ surface = "ruled" } end
    end
    a:done("figure 4.3 c-h", begin())
end)

-- A line along the top outline of a head from behind the brow to the crown, and where it is drawn anew.
local function outline(head, rise)
    local list = {}
    for i = 0, 12 do
        local angle = math.rad(40 + 100 * i / 12)
        local d = { 0, math.sin(angle), math.cos(angle) }
        local from = { 0, 0, 0 }
        for k = 2, 3 do from[k] = 2 * d[k] end
        local hit = head:pick(from, { 0, -d[2], -d[3] })
        local hump = 1 + rise * math.sin(math.pi * i / 12) ^ 2
        list[i + 1] = { 0, hit.position[2] * hump, hit.position[3] * hump }
    end
    return list
end

test("a silhouette is drawn anew: the back of a head", function()
    local head = lissom.shapes.head{ vertices = 6000 }
    local a = artist.new("redraw", { head = head }, { seed = 23, eye = { 2, 0, 0 }, ortho = 0.5 })
    local before, high = head:volume(), head:bounds().max[2]
    a:stroke(outline(head, 0))
    a:stroke(outline(head, 0.35))
    expect.truthy(head:volume() > 1.01 * before)
    expect.truthy(head:bounds().max[2] > high + 0.01)
    a.others = -1                    -- the first stroke says which line, and changes nothing
    a:done("silhouette", { head = lissom.shapes.head{ vertices = 6000 } })
end)
