--- Streams that a hand leads to the tie of a tail: they go into it. Points are in the head's own space.
local hair = require "tools.support.hair"
local vectors = require "vectors"

local tie = {}

local as_near = 24              -- pixels from the rim of a tie within which a stroke may end that means it
local as_deep = 0.045           -- metres from the rim within which it is, as its depth may be a guess

-- How far a point is from the rim of a tie in the picture; within it below 0.
local function pixels_from(camera, size, one, point)
    local edge = vectors.plus(one.center, camera:right(), one.radius)
    local x, y = camera:project(point, size)
    local u, v = camera:project(one.center, size)
    local wide = camera:project(edge, size)
    return math.sqrt((x - u) ^ 2 + (y - v) ^ 2) - math.abs(wide - u)
end

-- The tie that a line ends at; without a camera as near as its depth may be off.
local function tie_at(one, points, camera, size)
    local last, best, nearest = points[#points], nil, as_deep * one.scalp:scale()
    for _, curve in ipairs(hair.curves(one, "ponytail")) do
        local found = curve:tie()
        local deep = vectors.length(vectors.plus(last, found.center, -1)) - found.radius
        local is_seen = not camera or pixels_from(camera, size, found, last) < as_near
        if curve:enabled() and is_seen and deep < nearest then best, nearest = found, deep end
    end
    return best
end

-- Whether a point is beside a tie or behind it, so that hair that follows it would miss the tie.
local function is_past(found, point)
    local off = vectors.plus(point, found.center, -1)
    local height, far = vectors.dot(off, found.direction), vectors.length(off)
    return far < 1.3 * found.radius or (height > -0.3 * found.radius and far < 4 * found.radius)
end

--- Points of a stream that ends at a tie, as `camera` sees it, so that they end in it, half a radius from its
-- middle on the side that they come from; nil if it does not end at one.
function tie.led_into(one, points, camera, size)
    local found = tie_at(one, points, camera, size)
    if not found then return nil end
    local list = { table.unpack(points) }
    while #list > 2 and is_past(found, list[#list]) do table.remove(list) end
    local off = vectors.plus(list[#list], found.center, -1)
    local across = vectors.plus(off, found.direction, -vectors.dot(off, found.direction))
    if vectors.length(across) < 1e-9 then return nil end
    list[#list + 1] = vectors.plus(found.center, vectors.unit(across), 0.5 * found.radius)
    return list
end

return tie
