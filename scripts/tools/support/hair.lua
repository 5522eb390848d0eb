--- A hairstyle in a tool's hand: the style that is in the scene, the curve under the cursor, and the strands,
-- an object "<name of the style> hair" beside it.
local lissom = require "lissom"
local matrices = require "matrices"
local vectors = require "vectors"

local hair = {}

--- Parameters of a tool that grows hair.
hair.params = {
    strands = { type = "integer", default = 5000, min = 0, max = 200000, group = "hair",
        help = "How many strands follow the curves." },
    length = { type = "number", default = 0.25, min = 0.01, max = 1, unit = "metres", group = "hair",
        help = "Of the strands, on an average head." },
}

--- The parameters of a tool with those above.
function hair.with_params(own)
    local all = {}
    for _, list in ipairs{ hair.params, own } do
        for name, param in pairs(list) do all[name] = param end
    end
    return all
end

--- The first visible hairstyle of a scene: { name =, style =, scalp =, place =, strands =, length = }, with
-- the matrix from the head's own space to the world, and values of `params`; nil where there is none.
function hair.find(scene, params)
    for _, name in ipairs(scene:names()) do
        local info = scene:info(name)
        if info.kind == "hairstyle" and info.visible then
            local style = scene:get(name)
            return { name = name, style = style, scalp = style:scalp(), place = info.transform,
                strands = params and params.strands or hair.params.strands.default,
                length = params and params.length or hair.params.length.default }
        end
    end
    return nil
end

--- The same; an error that says what to do where there is none.
function hair.need(scene, params)
    return hair.find(scene, params)
        or error("no hairstyle is to be seen: add one, as scene:add('style', lissom.hairstyle(head))", 0)
end

--- A camera that sees the head's own space as `camera` sees the world.
function hair.camera(camera, one)
    local back, ortho = matrices.inverse(one.place), camera:ortho()
    local up = matrices.direction(back, camera:up())
    local scale = math.sqrt(up[1] ^ 2 + up[2] ^ 2 + up[3] ^ 2)
    return lissom.camera{ eye = matrices.point(back, camera:eye()), up = up, fov = camera:fov(),
        target = matrices.point(back, camera:target()), ortho = ortho and ortho * scale }
end

--- Curves of a style, of one kind where that is given.
function hair.curves(one, kind)
    local list = {}
    for _, curve in ipairs(one.style:curves()) do
        if not kind or curve:kind() == kind then list[#list + 1] = curve end
    end
    return list
end

-- Pixels from {x, y} to the segment a b of the picture, and the share along it.
local function pixels_to(x, y, a, b)
    local u, v = b[1] - a[1], b[2] - a[2]
    local square = u * u + v * v
    local t = square > 0 and math.max(0, math.min(1, ((x - a[1]) * u + (y - a[2]) * v) / square)) or 0
    return math.sqrt((x - a[1] - t * u) ^ 2 + (y - a[2] - t * v) ^ 2), t
end

--- Where a line is seen nearest to a pixel: { pixels =, segment =, along =, point = }, of points of the
-- head's own space; nil where it is not in front of the camera.
function hair.nearest(points, camera, size, x, y)
    local best, last
    for i, point in ipairs(points) do
        local px, py = camera:project(point, size)
        local here = px == px and { px, py } or nil
        if here and (last or #points == 1) then
            local pixels, t = pixels_to(x, y, last or here, here)
            local found = { pixels = pixels, segment = i - 1, along = t }
            if not best or pixels < best.pixels then best = found end
        end
        last = here
    end
    if not best then return nil end
    local a, b, t = points[math.max(best.segment, 1)], points[best.segment + 1], best.along
    best.point = { a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]), a[3] + t * (b[3] - a[3]) }
    return best
end

--- How far a point is from a line of the same space.
function hair.distance(points, point)
    local nearest = math.huge
    for i = 1, #points - 1 do
        local side, from = vectors.plus(points[i + 1], points[i], -1), vectors.plus(point, points[i], -1)
        local t = vectors.dot(from, side) / math.max(vectors.dot(side, side), 1e-30)
        local off = vectors.plus(from, side, -math.max(0, math.min(1, t)))
        nearest = math.min(nearest, vectors.length(off))
    end
    return nearest
end

-- Whether the head hides a point.
local function is_hidden(one, camera, size, point)
    local x, y, depth = camera:project(point, size)
    local hit = camera:pick{ mesh = one.scalp:head(), x = x, y = y, size = size }
    return hit ~= nil and hit.depth < depth - 0.01 * one.scalp:scale()
end

--- The curve that is seen within `radius` (10) pixels of the cursor and nearest to it, and where; nil where
-- there is none that the head does not hide. `kind` as in hair.curves; `preferred` wins where it is within 4
-- pixels of the nearest.
function hair.curve_at(ev, one, options)
    options = options or {}
    local camera, best, at = hair.camera(ev.camera, one), nil, nil
    for _, curve in ipairs(hair.curves(one, options.kind)) do
        local near = hair.nearest(curve:course(), camera, ev.size, ev.x, ev.y)
        local pixels = near and near.pixels - (curve == options.preferred and 4 or 0)
        if near and near.pixels <= (options.radius or 10) and not (best and at.weighed <= pixels)
            and not is_hidden(one, camera, ev.size, near.point) then
            best, at, near.weighed = curve, near, pixels
        end
    end
    return best, at
end

local function may_grow(style)
    for _, curve in ipairs(style:curves()) do
        if curve:enabled() then return true end
    end
    return false
end

--- Grows the strands of a style, or a share of them while something is dragged, into the object
-- "<name> hair", which is added where there is none, and removed where no curve is left.
function hair.grow(scene, one, share)
    local name = one.name .. " hair"
    local info, old = scene:info(name), scene:get(name)
    if info and info.kind ~= "strands" then
        error("'" .. name .. "' is a " .. info.kind .. ": rename it, hair goes by that name", 0)
    end
    if not may_grow(one.style) then
        if old then scene:remove(name) end
        return nil
    end
    local strands = assert(one.style:grow{ count = math.floor(one.strands * (share or 1)),
        length = one.length, into = old })
    if not old then scene:add(name, strands, { transform = one.place }) end
    return strands
end

--- Whether what was drawn is a click: all of it within 6 pixels.
function hair.is_click(pixels)
    for _, pixel in ipairs(pixels) do
        if math.abs(pixel[1] - pixels[1][1]) + math.abs(pixel[2] - pixels[1][2]) > 6 then return false end
    end
    return true
end

--- Draws a line of the head's own space; `options` are those of view:line.
function hair.line(view, one, points, options)
    local line = { points = {}, color = options.color, width = options.width, closed = options.closed }
    for i, point in ipairs(points) do line.points[i] = matrices.point(one.place, point) end
    view:line(line)
end

local colors = { stream = "#28b0c8", dividing = "#e04038", ponytail = "#b060d0" }

--- Draws the curves of a style, the chosen one wider.
function hair.draw(view, one, chosen)
    for _, curve in ipairs(one.style:curves()) do
        local color = curve:enabled() and colors[curve:kind()] or "#909090"
        hair.line(view, one, curve:course(), { color = color, width = curve == chosen and 5 or 2 })
        local pixels = {}                       -- and over the hair that hides it
        for i, point in ipairs(curve:course()) do
            local x, y, depth = view.camera:project(matrices.point(one.place, point), view.size)
            if depth > 0 and pixels then pixels[i] = { x, y } else pixels = nil end
        end
        if pixels then view:outline{ pixels = pixels, color = color, width = curve == chosen and 3 or 1 } end
    end
end

--- The stream after another one in a list; the first behind the last and for none.
function hair.after(list, curve)
    for i, one in ipairs(list) do
        if one == curve then return list[i % #list + 1] end
    end
    return list[1]
end

--- The place that hair.nearest has found, or the first point where it is near that: there a curve is held by
-- its root.
function hair.snapped(near, points)
    if near.segment ~= 1 or near.along > 0.5 then return near.point end
    near.along = 0
    return points[1]
end

--- Draws a supporting surface.
function hair.draw_support(view, one, support)
    local edges = { support:edges() }
    for _, edge in ipairs(edges) do
        for i, point in ipairs(edge) do edge[i] = matrices.point(one.place, point) end
    end
    view:surface{ from = edges[1], to = edges[2], color = "#f0c040", opacity = 0.22 }
    for _, edge in ipairs(edges) do view:line{ points = edge, color = "#f0c040", width = 1 } end
end

--- Says something at the cursor.
function hair.say(view, text)
    local origin, direction = view.camera:ray(view.cursor[1] + 12, view.cursor[2] - 12, view.size)
    local at = {}
    for axis = 1, 3 do at[axis] = origin[axis] + direction[axis] end
    view:label{ at = at, text = text }
end

return hair
