--- A hand that draws as people do: uneven speed, jitter, drift, hooks and overshoot at the ends, on whole
-- pixels, an event every 16 ms. It draws the images of lines of the world, counts its strokes and their time,
-- and what it has recorded is replayed.
--
--     local a = artist.new("stream", { style = style }, { seed = 3 })
--     a:look(0, 0):stroke(points)
--     a:done("bob")
local hair = require "tools.support.hair"
local hand = require "hand"
local lissom = require "lissom"

local artist = {}
artist.__index = artist

local size = { 1280, 960 }
local interval = 0.016          -- seconds between two events

--- As hand.new, with an own seed; the objects have a hairstyle called style.
function artist.new(tool, objects, options)
    options = options or {}
    local self = setmetatable({
        strokes = 0, clicks = 0, others = 0, seconds = 0, random = options.seed or 1, objects = objects },
        artist)
    self.hand = hand.new(tool, objects, { record = true, eye = options.eye, ortho = options.ortho })
    self.host, self.scene = self.hand.host, self.hand.scene
    self.style, self.metres = objects.style, options.metres or 0.42
    return self
end

--- Takes another tool, and sets its parameters.
function artist:use(name, values)
    local before = self.hand:steps()
    if self.hand.tool.name ~= name then self.hand:use(name) end
    self.host:set(values or {})
    self.others = self.others + self.hand:steps() - before      -- hair is grown anew
    return self
end

--- Looks at a head from a direction in degrees: 0 is from in front, 90 from its left, 180 from behind; the
-- picture is so many metres high, about a height in metres over the head's center.
function artist:look(azimuth, elevation, metres, height)
    local scalp, far = self.style:scalp(), 2
    local a, e = math.rad(azimuth), math.rad(elevation)
    local target = { 0, height or 0, 0 }
    local eye = { far * math.cos(e) * math.sin(a), target[2] + far * math.sin(e),
        far * math.cos(e) * math.cos(a) }
    self:look_by(lissom.camera{ eye = scalp:from_metres(eye), target = scalp:from_metres(target),
        ortho = (metres or self.metres) * scalp:scale() })
    return self
end

function artist:look_by(camera)
    self.hand.camera = camera
    self.host:look(camera)
end

-- ---- Chance, the same on every machine

function artist:uniform()
    self.random = (self.random * 1103515245 + 12345) % 2147483648
    return (self.random + 0.5) / 2147483648
end

function artist:normal()
    return math.sqrt(-2 * math.log(self:uniform())) * math.cos(2 * math.pi * self:uniform())
end

-- ---- A stroke as it is meant, and as it comes out

local function plus(a, b, s) return { a[1] + s * b[1], a[2] + s * b[2] } end
local function length(a) return math.sqrt(a[1] ^ 2 + a[2] ^ 2) end

-- A smooth line through points, at steps of a pixel (Catmull-Rom).
local function meant(points)
    local line = {}
    for i = 1, #points - 1 do
        local b, c = points[i], points[i + 1]
        local a, d = points[i - 1] or b, points[i + 2] or c
        local steps = math.max(1, math.floor(length(plus(c, b, -1))))
        for step = 0, steps - 1 do
            local t, p = step / steps, {}
            for k = 1, 2 do
                p[k] = 0.5 * (2 * b[k] + (c[k] - a[k]) * t + (2 * a[k] - 5 * b[k] + 4 * c[k] - d[k]) * t ^ 2
                    + (3 * b[k] - a[k] - 3 * c[k] + d[k]) * t ^ 3)
            end
            line[#line + 1] = p
        end
    end
    line[#line + 1] = points[#points]
    return line
end

-- 1 over the radius of the bend of a line at a place, over 12 pixels to both sides.
local function bend(line, i)
    local a, b, c = line[math.max(1, i - 12)], line[i], line[math.min(#line, i + 12)]
    local u, v = plus(b, a, -1), plus(c, b, -1)
    local lu, lv = length(u), length(v)
    if lu < 1 or lv < 1 then return 0 end
    local cosine = math.max(-1, math.min(1, (u[1] * v[1] + u[2] * v[2]) / lu / lv))
    return 2 * math.acos(cosine) / (lu + lv)
end

-- Puts a hook before the first point of half of the strokes, and lets a third run on.
function artist:with_ends(line)
    local first, second, last = line[1], line[math.min(12, #line)], line[#line]
    if self:uniform() < 0.5 then
        local along = plus(second, first, -1)
        local turn, long = math.rad(70 + 70 * self:uniform()), 4 + 3 * self:uniform()
        local c, s, l = math.cos(turn), math.sin(turn), math.max(length(along), 1)
        local hook = { (c * along[1] - s * along[2]) / l, (s * along[1] + c * along[2]) / l }
        for i = 1, math.floor(long) do table.insert(line, 1, plus(first, hook, i)) end
    end
    if self:uniform() < 0.33 then
        local along = plus(last, line[math.max(1, #line - 12)], -1)
        for i = 1, 6 do line[#line + 1] = plus(last, along, i / math.max(length(along), 1)) end
    end
    return line
end

-- The pixels of the events of a stroke along a line.
function artist:events(line)
    local speed, jitter = 350 + 500 * self:uniform(), 0.5 + 0.7 * self:uniform()
    local wave, phase, drift = 23 + 37 * self:uniform(), 6.28 * self:uniform(), 0.5 * jitter
    local list, place, off = {}, 1, { 0, 0 }
    while place < #line do
        local i = math.floor(place)
        for k = 1, 2 do off[k] = 0.6 * off[k] + 0.8 * jitter * self:normal() end
        local slow = drift * math.sin(6.28 * place / wave + phase)
        local p = plus(plus(line[i], off, 1), { slow, -slow }, 1)
        list[#list + 1] = { math.floor(p[1] + 0.5), math.floor(p[2] + 0.5) }
        local ends = math.min(1, 0.25 + math.min(place, #line - place) / 60)
        local slower = math.min(1, (0.006 / math.max(bend(line, i), 1e-6)) ^ (1 / 3))
        place = place + math.max(0.5, speed * ends * slower * interval)
    end
    local last = line[#line]
    list[#list + 1] = { math.floor(last[1] + 0.5), math.floor(last[2] + 0.5) }
    return list
end

--- Draws a line of pixels by hand; `options` are those of events (shift =, alt =).
function artist:pixels(points, options)
    local list = self:events(self:with_ends(meant(points)))
    local function event(p)
        local all = { x = p[1], y = p[2] }
        for key, value in pairs(options or {}) do all[key] = value end
        return all
    end
    self.host:press(event(list[1]))
    for i = 2, #list do self.host:move(event(list[i])) end
    self.host:release(event(list[#list]))
    self.strokes, self.seconds = self.strokes + 1, self.seconds + interval * #list
    return self
end

--- The pixels at which points of the world are seen.
function artist:seen(points)
    local list = {}
    for i, point in ipairs(points) do list[i] = { self.hand.camera:project(point, size) } end
    return list
end

--- Draws the image of a line of the world.
function artist:stroke(points, options) return self:pixels(self:seen(points), options) end

--- Clicks on a curve where the head does not hide it, from its tip on.
function artist:choose(curve)
    local course = curve:course()
    for i = #course, 1, -1 do
        local x, y = self.hand.camera:project(course[i], size)
        local ev = { camera = self.hand.camera, size = size, x = x, y = y }
        if hair.curve_at(ev, hair.find(self.scene)) == curve then
            self.host:click{ x = x, y = y }
            self.clicks = self.clicks + 1
            return self
        end
    end
    error("the curve is hidden")
end

--- Presses a key that changes something.
function artist:key(key)
    self.host:key{ key = key }
    self.others = self.others + 1
    return self
end

--- Draws an ellipse around a point of the world, of radii in pixels.
function artist:ring(center, wide, high, share)
    local x, y = self.hand.camera:project(center, size)
    local list = {}
    for i = 0, 24 do
        local turn = 2 * math.pi * (share or 1.04) * i / 24
        list[i + 1] = { x + wide * math.cos(turn), y + high * math.sin(turn) }
    end
    return self:pixels(list)
end

-- ---- Streams

--- How far a curve is from the line that it was drawn after, but for the root, in metres of an average head:
-- the root of the mean square.
function artist:off(curve, route)
    local sum, course, scale = 0, curve:points(), self.style:scalp():scale()
    for i = 2, #route do sum = sum + (hair.distance(course, route[i]) / scale) ^ 2 end
    return math.sqrt(sum / (#route - 1))
end

--- Draws a stream as it is seen from one side, and where there is a second one again from there:
-- { azimuth, elevation } each, with the number of the first point that is drawn again as a third. Returns
-- how far off it is then, and how far it was before.
function artist:stream(places, first, second)
    local points, before = self.route(places), #self.style:curves()
    self:look(first[1], first[2]):stroke(points)
    local curve = self.style:curves()[before + 1]
    expect.truthy(curve)
    local guessed = self:off(curve, points)
    if not second then return guessed, guessed end
    self:look(second[1], second[2])
    local seen, course = self:seen(points), curve:course()
    local from = second[3] or 1
    seen = table.move(seen, from, #seen, 1, {})
    local near = hair.nearest(course, self.hand.camera, size, seen[1][1], seen[1][2])
    seen[1] = self:seen{ from == 1 and course[1] or near.point }[1]
    self:choose(curve):pixels(seen)
    self.host:click{ x = 5, y = 5 }
    expect.equal(#self.style:curves(), before + (self.hand.tool.params.symmetric and 2 or 1))
    return self:off(curve, points), guessed
end

--- Says how many strokes it took, and replays what was recorded in a scene of `fresh` objects: to one hash.
function artist:done(name, fresh)
    print(string.format("%-18s %2d strokes, %2d clicks, %4.1f s by hand", name, self.strokes,
        self.clicks, self.seconds))
    if os.getenv("LISSOM_SKETCHES") and self.style then self:show(name) end
    local file = os.tmpname()
    local stream = assert(io.open(file, "w"))
    stream:write(self.host:recording())
    stream:close()
    local other = hand.new("select", fresh)
    lissom.replay(file, { scene = other.scene })
    os.remove(file)
    expect.equal(other.scene:hash(), self.scene:hash())
    expect.equal(other:steps(), self.hand:steps())
    expect.equal(self.hand:steps(), self.strokes + self.others)
end

-- Its file, and pictures of it with many strands, in the folder that the environment names.
function artist:show(name)
    local style, folder = self.style, os.getenv("LISSOM_SKETCHES")
    local scalp, long = style:scalp(), self.hair_length or 0.25
    local count = tonumber(os.getenv("LISSOM_STRANDS") or 100000)
    local one = hair.find(self.scene, self.hand.tool.params)
    assert(style:save(folder .. "/" .. name .. ".json"))
    local strands = assert(style:grow{ count = count, length = long, cut = hair.cut(one) })
    require("hairdo").detail(strands)
    for _, view in ipairs(self.views or { { 0, 4 }, { 35, 12 }, { 90, 4 }, { 180, 4 } }) do
        local a, e, far = math.rad(view[1]), math.rad(view[2]), 2
        local low = self.low or 0
        local eye = scalp:from_metres(far * math.cos(e) * math.sin(a), low + far * math.sin(e),
            far * math.cos(e) * math.cos(a))
        assert(lissom.render{ mesh = scalp:head(), color = "clay", strands = strands, size = { 700, 700 },
            background = "#c8ccd2", file = folder .. "/" .. name .. "_" .. view[1] .. ".png",
            camera = lissom.camera{ eye = eye, target = scalp:from_metres(0, low, 0),
                ortho = (self.high or 0.45) * scalp:scale() } })
    end
end

return artist
