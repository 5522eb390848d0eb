-- Whole hairstyles sketched by a hand with noise and uneven speed: few strokes and seconds, replayed to one
-- hash. With LISSOM_SKETCHES=FOLDER each is drawn there, too.
local artist = require "artist"
local hair = require "tools.support.hair"
local lissom = require "lissom"
local route_of = require("strokes").route
local strokes = require "strokes"

local by = strokes.by

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
    a.extra, a.hair_length = 2, 0.25
    a:done("asymmetric bob", begin())
end)
