--- A ponytail in a tool's hand: the strokes that make it (its spine, the section around it, the profiles
--- beside it), and its handles. Points are in the head's own space.
local lissom = require "lissom"
local curves = require "tools.support.curves"
local hair = require "tools.support.hair"
local hair_view = require "tools.support.hair_view"
local hairdo = require "hairdo"
local vectors = require "vectors"

local tail = {}

local tie_height = 0.018    -- metres over the head at which a tail is tied, best
local lift = 0.025          -- metres in front of the head that a spine is drawn in
local beside = 0.06         -- metres from the spine in which its profiles begin
local firm = 0.05           -- metres from the tie to the handle of a tightness of 1

local function middle_of(pixels)
    local x, y = 0, 0
    for _, pixel in ipairs(pixels) do x, y = x + pixel[1], y + pixel[2] end
    return x / #pixels, y / #pixels
end

local function length_of(pixels)
    local sum = 0
    for i = 2, #pixels do
        sum = sum + math.sqrt((pixels[i][1] - pixels[i - 1][1]) ^ 2 + (pixels[i][2] - pixels[i - 1][2]) ^ 2)
    end
    return sum
end

-- Kind of a stroke round a tail: "all" if its ends are near each other for its width, "half" if it is bent
-- but open; and its width.
local function round(pixels)
    local low, high = { math.huge, math.huge }, { -math.huge, -math.huge }
    for _, pixel in ipairs(pixels) do
        for k = 1, 2 do low[k], high[k] = math.min(low[k], pixel[k]), math.max(high[k], pixel[k]) end
    end
    local width = math.max(high[1] - low[1], high[2] - low[2])
    local apart, length = length_of{ pixels[1], pixels[#pixels] }, length_of(pixels)
    if apart < 0.6 * width and length > 1.7 * width then return "all", width end
    return length > 1.3 * apart and "half" or nil, width
end

-- How much a stroke runs along a spine, 0 to 1, as both are seen.
local function along(camera, size, spine, pixels)
    local sum, whole = 0, 0
    for i = 2, #pixels do
        local a, b = pixels[i - 1], pixels[i]
        local near = hair.nearest(spine, camera, size, b[1], b[2])
        local x, y = camera:project(spine[near.segment], size)
        local u, v = camera:project(spine[near.segment + 1], size)
        local length = math.sqrt((u - x) ^ 2 + (v - y) ^ 2)
        if length > 0 then
            sum = sum + ((b[1] - a[1]) * (u - x) + (b[2] - a[2]) * (v - y)) / length
        end
        whole = whole + length_of{ a, b }
    end
    return whole > 0 and math.abs(sum) / whole or 0
end

-- A section in the plane across the view with the spine in the middle of it.
local function section_points(ev, spine, camera, fair)
    local x, y = middle_of(fair)
    local _, _, depth = camera:project(hair.nearest(spine, camera, ev.size, x, y).point, ev.size)
    local points = {}
    for i, pixel in ipairs(fair) do points[i] = camera:unproject({ pixel[1], pixel[2], depth }, ev.size) end
    return points
end

local strip_width = 0.08    -- metres to each side of a spine on which profiles are drawn

-- A profile on the strip of the spine that faces the view.
local function profile_points(stroke, ev, curve, camera)
    stroke.support = curve:support{ mode = "strip", camera = camera, width = strip_width }
    local given = { points = stroke.pixels, size = ev.size, on = stroke.support }
    return camera:stroke(given).points, stroke.support:end_on() > 1 / 3
end

local parts = {}

-- Place of a stroke at a tail: whether its middle is on the spine, it begins at it, or beside it.
function parts.place(ev, one, camera, spine, pixels, width)
    local x, y = middle_of(pixels)
    local middle = hair.nearest(spine, camera, ev.size, x, y)
    local first = hair.nearest(spine, camera, ev.size, pixels[1][1], pixels[1][2])
    if not middle or not first then return nil end
    local _, _, depth = camera:project(first.point, ev.size)
    local start = camera:unproject({ pixels[1][1], pixels[1][2], depth }, ev.size)
    return { is_around = middle.pixels < width / 2, is_at = first.pixels < 20,
        is_beside = hair.distance(spine, start) < beside * one.scalp:scale() }
end

function parts.section(ev, curve, camera, pixels)
    return { name = "tie", act = function()
        curve:set{ section = section_points(ev, curve:course(), camera, pixels) }
    end }
end

function parts.profile(stroke, ev, curve, camera)
    return { name = "profile", act = function()
        local points, end_on = profile_points(stroke, ev, curve, camera)
        curve:set{ profiles = tail.with_profile(curve, points) }
        return nil, end_on and "the tail is seen end-on: turn the view" or nil
    end }
end

function parts.refused(text) return { name = "nothing", act = function() error(text, 0) end } end

-- Hints to the spine, as to a stream.
function parts.hints(viewpoint, stroke, ev, one, camera, pixels)
    local curve = stroke.target
    local list = {}
    for i, name in ipairs(curves.readings(curve, camera, ev.size, pixels) or {}) do
        list[i] = { name = name, act = function()
            stroke.support = curves.support(curve, "auto", camera, viewpoint)
            local given = { points = stroke.pixels, size = ev.size, on = stroke.support }
            curves.apply(curve, name, camera:stroke(given).points)
            if name ~= "cut" then curve:set{ spine = tail.leaving(one, curve:points()) } end
            return nil, stroke.support:mode() == "ruled" and "in depth" or nil
        end }
    end
    return list
end

--- Readings of a stroke at the tail that is its target, likeliest first, as curve_tool has them; empty if it
-- is not at it. The tail was drawn from `viewpoint`.
function tail.readings(viewpoint, stroke, ev, one)
    local curve = stroke.target
    local camera, spine = hair.camera(ev.camera, one), curve:course()
    local pixels = camera:stroke{ points = stroke.pixels, size = ev.size }.pixels
    local way, width = round(pixels)
    local place = parts.place(ev, one, camera, spine, pixels, width)
    if not place then return {} end
    local is_near = place.is_at or place.is_beside
    local hints = is_near and parts.hints(viewpoint, stroke, ev, one, camera, pixels) or {}
    local first
    if way == "all" and place.is_around then
        first = parts.section(ev, curve, camera, pixels)
    elseif not place.is_beside or (place.is_at and way ~= "half") then
        return hints
    elseif along(camera, ev.size, spine, pixels) > 0.7 then
        first = parts.profile(stroke, ev, curve, camera)
    elseif way == "half" and place.is_around then
        first = parts.refused("half a ring: draw all the way round the tail, for the tie")
    elseif #hints == 0 then
        first = parts.refused("beside a tail draw all the way round it, for the tie, or along it, for how it "
            .. "swells")
    end
    if first then table.insert(hints, 1, first) end
    return hints
end

local in_profile = 0.94         -- cosine to the head's left within which it is seen in profile
local aside = 0.065             -- metres off the middle within which a root may mean a tail in the middle

--- Whether a stroke means a tail in the middle of the head: drawn in profile, away from the head.
function tail.is_in_middle(ev, one, pixels)
    local camera, away = hair.camera(ev.camera, one), 0
    if math.abs(vectors.dot(camera:forward(), one.scalp:left())) < in_profile then return false end
    local root
    for _, pixel in ipairs(pixels) do
        local hit = one.scalp:head():pick(camera:ray(pixel[1], pixel[2], ev.size))
        root = root or hit
        away = away + (hit and 0 or 1)
    end
    local off = root and math.abs(one.scalp:to_metres(root.position)[1])
    return off ~= nil and off < aside and away > 0.4 * #pixels
end

-- How far a point is over the head, below 0 in it.
local function height(head, point)
    local near = head:nearest(point)
    local is_out = vectors.dot(vectors.plus(point, near.position, -1), near.normal) >= 0
    return is_out and near.distance or -near.distance
end

local leaving = 0.035           -- metres over which a tail leaves the head straight

--- Points of a spine so that it leaves the head along its normal, and then goes on as it was drawn: a tie
-- that is tilted would have hair get in from one side alone.
function tail.leaving(one, points)
    local metre, length, list = one.scalp:scale(), 0, { points[1] }
    local near = one.scalp:head():nearest(points[1])
    local away = vectors.plus(points[1], near.position, -1)
    if vectors.length(away) < 1e-6 * metre or vectors.dot(away, near.normal) <= 0 then return points end
    for i = 2, #points do
        length = length + vectors.length(vectors.plus(points[i], points[i - 1], -1))
        local straight = vectors.plus(points[1], vectors.unit(away), length)
        local t = math.max(0, 1 - length / (leaving * metre))
        list[i] = vectors.plus(points[i], vectors.plus(straight, points[i], -1), t * t * (3 - 2 * t))
    end
    return list
end

--- The spine of a tail from a stroke over the head, or in the middle of it: from a point high enough for a
-- tie.
function tail.spine(ev, one, pixels, in_middle)
    local scalp, given = one.scalp, { points = pixels, size = ev.size }
    if in_middle then
        given.plane = { point = scalp:center(), normal = scalp:left() }
    else
        given.on, given.lift = scalp, lift
    end
    local points, heights, highest = hair.camera(ev.camera, one):stroke(given).points, {}, 0
    for i, point in ipairs(points) do
        heights[i] = height(scalp:head(), point)
        highest = math.max(highest, heights[i])
    end
    local wanted, first = math.min(tie_height * scalp:scale(), 0.8 * highest), 1
    while heights[first] < wanted do first = first + 1 end
    return tail.leaving(one, table.move(points, first, #points, 1, {}))
end

-- From the spine to a point beside it, and how far along the spine that is.
local function off_spine(spine, point)
    local best, nearest, place, length = nil, math.huge, 0, 0
    for i, at in ipairs(spine) do
        local off = vectors.plus(point, at, -1)
        if i > 1 then length = length + vectors.length(vectors.plus(at, spine[i - 1], -1)) end
        if vectors.length(off) < nearest then best, nearest, place = off, vectors.length(off), length end
    end
    return best, place
end

-- The same to the middle of a line.
local function offset(spine, points) return (off_spine(spine, points[math.ceil(#points / 2)])) end

-- A profile from the tie on: if it begins farther on, and no section is drawn, the tie would go there.
local function from_tie(curve, points)
    local tie, spine, line = curve:tie(), curve:course(), { table.unpack(points) }
    local off, place = off_spine(spine, line[1])
    local other, last = off_spine(spine, line[#line])
    if last < place then
        for i = 1, #points do line[i] = points[#points + 1 - i] end
        off, place = other, last
    end
    local across = vectors.plus(off, tie.direction, -vectors.dot(off, tie.direction))
    if #curve:section() > 0 or place < tie.radius or vectors.length(across) < 1e-9 then return points end
    table.insert(line, 1, vectors.plus(tie.center, vectors.unit(across), tie.radius))
    return line
end

--- The profiles of a tail with a new one, which takes the place of that on its side.
function tail.with_profile(curve, points)
    points = from_tie(curve, points)
    local list, spine = curve:profiles(), curve:course()
    for side = 1, 2 do
        if #list[side] > 0 and vectors.dot(offset(spine, list[side]), offset(spine, points)) > 0 then
            list[side] = points
            return list
        end
    end
    list[#list[1] == 0 and 1 or 2] = points
    return list
end

-- Inner and outer radius of the ring in which hair is drawn into a tie, in metres.
local function ring_of(options)
    local inner = options.inner * options.radius
    return inner, math.max(options.outer * options.radius, inner + options.ring)
end

-- Two unit vectors across the direction of a tie: level, and up as far as can be.
local function across(one, direction)
    local level = vectors.cross(direction, one.scalp:up())
    if vectors.length(level) < 0.1 then level = vectors.cross(direction, one.scalp:front()) end
    level = vectors.unit(level)
    return level, vectors.cross(level, direction)
end

--- The handles of a tail: both radii of its ring, and its tightness.
function tail.handles(one, curve)
    local tie, options, metre = curve:tie(), curve:options(), one.scalp:scale()
    local level, up = across(one, tie.direction)
    local inner, outer = ring_of(options)
    local function handle(name, way, length)
        local at = vectors.plus(tie.center, way, length * metre)
        return { option = name, base = tie.center, way = way, at = at }
    end
    return { handle("inner", level, inner), handle("outer", level, outer),
        handle("tightness", up, firm * (0.2 + 0.8 * options.tightness)) }
end

--- Takes a handle of a tail to a length in metres from its base.
function tail.drag(curve, held, length)
    local options = curve:options()
    local inner, outer = ring_of(options)
    if held.option == "tightness" then
        return curve:set{ tightness = math.max(0, math.min(1, (length / firm - 0.2) / 0.8)) }
    elseif held.option == "inner" then
        inner = math.max(0.5 * options.radius, math.min(length, outer))
    else
        outer = math.max(inner, math.min(length, 0.15))
    end
    curve:set{ inner = inner / options.radius, outer = outer / options.radius, ring = outer - inner }
end

-- With two arguments in every Lua.
local atan2 = rawget(math, "atan2") or math.atan

-- The direction of a tie from the middle of the head and its height over the head, as hairdo.gather has it.
local function direction_of(scalp, tie)
    local p = scalp:to_metres(tie.center)
    local far = vectors.length(p)
    local place = { azimuth = math.deg(atan2(p[1], p[3])), elevation = math.deg(math.asin(p[2] / far)) }
    place.lift = far - vectors.length(scalp:to_metres(scalp:at(place)))
    place.radius = tie.radius / scalp:scale()
    return place
end

local gathered = { count = 8, reach = 0.14, low = 0.006 }       -- metres
local in_tie = 0.03             -- metres from a tie within which streams end that were gathered into it

-- Whether a point is nearer to the tie of another tail.
local function is_of_other(one, curve, point)
    local nearest, best = math.huge, nil
    for _, other in ipairs(hair.curves(one, "ponytail")) do
        local off = vectors.length(vectors.plus(point, other:tie().center, -1))
        if off < nearest then best, nearest = other, off end
    end
    return best ~= curve
end

--- Draws streams over the hair around a tail into its tie, in place of former such streams; not from points
-- nearer to another tail.
function tail.gather(one, curve)
    local tie, scalp = curve:tie(), one.scalp
    for _, stream in ipairs(hair.curves(one, "stream")) do
        local points = stream:points()
        local off = vectors.length(vectors.plus(points[#points], tie.center, -1))
        if stream:name():find("^gather ") and off < in_tie * scalp:scale() then stream:remove() end
    end
    local region, options = scalp:region(), {}
    for key, value in pairs(gathered) do options[key] = value end
    function options.skip(azimuth, elevation)
        local found, at = pcall(scalp.at, scalp, { azimuth = azimuth, elevation = elevation })
        return not found or not region:contains(scalp:head():nearest(at).vertex)
            or is_of_other(one, curve, at)
    end
    hairdo.gather(one.style, direction_of(scalp, tie), options)
end

--- Fraction of the hair of a style in its tails, 0 to 1; 1 if streams lead other hair elsewhere.
function tail.share(one, strands)
    local counted, sum = {}, 0
    for _, curve in ipairs(one.style:curves()) do
        if curve:kind() == "stream" and curve:options().stop > 0 then return 1 end
        local name = curve:kind() == "ponytail" and curve:name()
        if name and not counted[name] then
            local own = lissom.try(strands.select, strands, { group = name })
            counted[name], sum = true, sum + (own and #own or 0)
        end
    end
    return #strands > 0 and sum / #strands or 1
end

-- A circle around a tie.
local function draw_circle(view, one, tie, radius)
    local level, up = across(one, tie.direction)
    local points = {}
    for i = 1, 40 do
        local turn, metres = 2 * math.pi * i / 40, radius * one.scalp:scale()
        local side = vectors.plus(tie.center, level, math.cos(turn) * metres)
        points[i] = vectors.plus(side, up, math.sin(turn) * metres)
    end
    hair_view.line(view, one, points, { color = "#e8a33d", width = 2, closed = true })
end

--- Draws the tie of a tail, its ring, and the strokes for it.
function tail.draw(view, one, curve)
    local tie, inner, outer = curve:tie(), ring_of(curve:options())
    for _, radius in ipairs{ tie.radius, inner, outer } do draw_circle(view, one, tie, radius) end
    local drawn = curve:profiles()
    drawn[3] = curve:section()
    for i, points in ipairs(drawn) do
        local look = { color = "#d090f0", width = 3, closed = i == 3 }
        if #points > 0 then hair_view.line(view, one, points, look) end
    end
end

return tail
