--- Edits of style curves by hand: hint strokes on a supporting surface, pulling, rubbing, mirror images.
-- Cameras and points are of the head's own space.
local hair = require "tools.support.hair"
local vectors = require "vectors"

local curves = {}

--- Points on the other side of the head.
function curves.mirrored(scalp, points)
    local list = {}
    for i, point in ipairs(points) do
        local p = scalp:to_metres(point)
        list[i] = scalp:from_metres(-p[1], p[2], p[3])
    end
    return list
end

--- Mirrors points: a point, a list of points, lists of those.
function curves.mirror_image(scalp, given)
    if type(given[1]) == "number" then return curves.mirrored(scalp, { given })[1] end
    local image = {}
    for key, value in pairs(given) do image[key] = curves.mirror_image(scalp, value) end
    return image
end

local in_middle = 0.008            -- metres from its mirror image within which a curve is in the middle

--- Whether a curve runs in the middle of the head: it is its own mirror image.
function curves.is_middle(one, curve)
    local points, metre = curve:points(), one.scalp:scale()
    for _, point in ipairs(curves.mirrored(one.scalp, points)) do
        if hair.distance(points, point) > in_middle * metre then return false end
    end
    return true
end

-- With two arguments in every Lua.
local atan2 = rawget(math, "atan2") or math.atan

--- Points moved so that the first is at another place of the head, turned with it about the head's height.
function curves.copied(scalp, points, root)
    local from, to = scalp:to_metres(points[1]), scalp:to_metres(root)
    local turn = atan2(to[1], to[3]) - atan2(from[1], from[3])
    local c, s, list = math.cos(turn), math.sin(turn), { root }
    for i = 2, #points do
        local p = vectors.plus(scalp:to_metres(points[i]), from, -1)
        list[i] = scalp:from_metres(to[1] + c * p[1] + s * p[3], to[2] + p[2], to[3] - s * p[1] + c * p[3])
    end
    return list
end

--- The stream that is the mirror image of another one; nil if there is none, or it is its own.
function curves.partner(one, curve)
    local points, scale = curve:points(), one.scalp:scale()
    local image = curves.mirrored(one.scalp, points)
    for _, other in ipairs(one.style:curves()) do
        local list = other:points()
        if other ~= curve and other:kind() == curve:kind() and #list == #points then
            local is_image = true
            for i, point in ipairs(list) do
                is_image = is_image and vectors.length(vectors.plus(point, image[i], -1)) < 1e-4 * scale
            end
            if is_image then return other end
        end
    end
    return nil
end

-- Degrees by which a camera is turned about the curve's middle against another.
local function turned(points, a, b)
    local middle = points[math.floor(#points / 2) + 1]
    local function sight(camera)
        if camera:ortho() then return camera:forward() end
        return vectors.unit(vectors.plus(middle, camera:eye(), -1))
    end
    local u, v = sight(a), sight(b)
    local cosine = u[1] * v[1] + u[2] * v[2] + u[3] * v[3]
    return math.deg(math.acos(math.max(-1, math.min(1, cosine))))
end

--- Returns the supporting surface of a curve for strokes that are drawn with `camera`; the curve was drawn
-- with `viewpoint`. `mode` is ruled, strip, or auto: the strip of the camera itself, and from 50 degrees
-- beside the viewpoint on the ruled surface of that.
function curves.support(curve, mode, camera, viewpoint)
    viewpoint = viewpoint or camera
    if mode ~= "auto" then return curve:support{ mode = mode, camera = viewpoint } end
    local angle = turned(curve:points(), camera, viewpoint)
    if angle > 50 and angle < 130 then
        local ruled = curve:support{ mode = "ruled", camera = viewpoint }
        if ruled:seen_from(camera) > 0.4 then return ruled end
    end
    return curve:support{ mode = "strip", camera = camera }
end

-- Whether a stroke begins at the root of a curve, as it is seen: there nothing would be left of it by a cut.
local function begins_at_root(curve, camera, size, pixels)
    local x, y = camera:project(curve:points()[1], size)
    return (x - pixels[1][1]) ^ 2 + (y - pixels[1][2]) ^ 2 < 20 ^ 2
end

--- Readings of a hint stroke for a curve: names, likeliest first, and the reading of the kernel; nil if it is
-- nowhere near.
function curves.readings(curve, camera, size, pixels)
    local near, reading = pcall(curve.read_hint, curve, { camera = camera, points = pixels, size = size })
    if not near then return nil end
    local names = { reading.operation, table.unpack(reading.others) }
    if names[1] == "cut" and names[2] and begins_at_root(curve, camera, size, pixels) then
        table.insert(names, table.remove(names, 1))
    end
    return names, reading
end

local at_root, fade = 0.02, 0.03        -- metres

-- A hint that begins at the root of a curve begins in it, without a loop there: moved ever less over 3 cm.
local function rooted(curve, hint)
    local root, metre = curve:points()[1], curve:hairstyle():scalp():scale()
    local by = vectors.plus(root, hint[1], -1)
    if vectors.length(by) > at_root * metre then return hint end
    local list, length = {}, 0
    for i, point in ipairs(hint) do
        if i > 1 then length = length + vectors.length(vectors.plus(point, hint[i - 1], -1)) end
        local t = math.max(0, 1 - length / (fade * metre))
        list[i] = vectors.plus(point, by, t * t * (3 - 2 * t))
    end
    return list
end

--- Applies the reading of a hint to a curve.
function curves.apply(curve, operation, hint)
    local reach = { reach = 1 }
    if operation ~= "cut" then hint = rooted(curve, hint) end
    if operation ~= "cut" then reach.join = 0.015 end
    return curve[operation](curve, hint, reach)
end

--- Points moved by a vector: all of it at arc length `place`, less and less within `reach` of there.
function curves.pulled(points, place, by, reach)
    local list, length = {}, 0
    for i, point in ipairs(points) do
        if i > 1 then length = length + vectors.length(vectors.plus(point, points[i - 1], -1)) end
        local t = math.max(0, 1 - math.abs(length - place) / reach)
        list[i] = vectors.plus(point, by, t * t * (3 - 2 * t))
    end
    return list
end

--- Arc length of a place that hair.nearest has found.
function curves.place(points, near)
    local length = 0
    for i = 2, near.segment do
        length = length + vectors.length(vectors.plus(points[i], points[i - 1], -1))
    end
    local a, b = points[math.max(near.segment, 1)], points[near.segment + 1]
    return length + near.along * vectors.length(vectors.plus(b, a, -1))
end

--- Points within `radius` of one of them moved towards the middle of their neighbours; the ends stay.
function curves.rubbed(points, at, radius)
    local list = { points[1] }
    for i = 2, #points - 1 do
        local t = math.max(0, 1 - vectors.length(vectors.plus(points[i], at, -1)) / radius)
        local middle = vectors.plus(points[i - 1], points[i + 1], 1)
        list[i] = vectors.plus(vectors.plus({ 0, 0, 0 }, points[i], 1 - 0.5 * t), middle, 0.25 * t)
    end
    list[#points] = points[#points]
    return list
end

return curves
