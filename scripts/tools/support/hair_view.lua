--- Marks of hair tools over the picture: curves, faint if the head hides them and glowing under the cursor;
-- supporting surfaces, the field around the cursor, and words there.
local hair = require "tools.support.hair"
local matrices = require "matrices"
local vectors = require "vectors"

local hair_view = {}

local colors = { stream = "#28b0c8", dividing = "#e04038", ponytail = "#b060d0" }
local glow = "#ffd24a"
local faint = 0.3               -- opacity of curves behind the head

--- Draws a line of the head's own space; `options` are those of view:line.
function hair_view.line(view, one, points, options)
    local line = { points = {}, color = options.color, width = options.width, closed = options.closed }
    for i, point in ipairs(points) do line.points[i] = matrices.point(one.place, point) end
    view:line(line)
end

-- A line as it is seen, in pieces of which the head hides all or nothing: { pixels =, hidden = }.
local function seen_pieces(view, one, camera, points)
    local pieces, piece = {}, nil
    for i, point in ipairs(points) do
        local x, y = camera:project(point, view.size)
        if x ~= x then
            piece = nil
        else
            local hidden = hair.is_hidden(one, camera, view.size, point)
            if not piece or piece.hidden ~= hidden then
                local last = piece and piece.pixels[#piece.pixels]
                piece = { pixels = { last }, hidden = hidden }
                table.insert(pieces, piece)
            end
            table.insert(piece.pixels, { x, y })
        end
        if i == #points and piece and #piece.pixels == 1 then table.insert(piece.pixels, { x + 1, y }) end
    end
    return pieces
end

-- A line over the hair, with a glow around it, and faint behind the head.
local function draw_seen(view, one, camera, points, look)
    for _, piece in ipairs(seen_pieces(view, one, camera, points)) do
        if look.glows then
            view:outline{ pixels = piece.pixels, color = glow, width = look.width + 8, opacity = 0.5 }
        end
        view:outline{ pixels = piece.pixels, color = look.color, width = look.width,
            opacity = piece.hidden and faint or 1 }
    end
end

--- Draws the curves of a style: the chosen one wider, and that which a click would choose with a glow. `kind`
-- is that of the tool.
function hair_view.curves(view, one, kind, chosen, is_busy)
    local camera, under = hair.camera(view.camera, one), nil
    if view.cursor and not is_busy then
        under = hair.curve_at(hair_view.event(view), one, { kind = kind, preferred = chosen })
    end
    for _, curve in ipairs(one.style:curves()) do
        local color = curve:enabled() and colors[curve:kind()] or "#909090"
        local width = curve == chosen and 3 or 1.5
        local course = curve:course()
        hair_view.line(view, one, course, { color = color, width = width })
        draw_seen(view, one, camera, course, { color = color, width = width, glows = under == curve })
    end
    return under
end

--- The event that the cursor would be.
function hair_view.event(view)
    return { camera = view.camera, size = view.size, x = view.cursor[1], y = view.cursor[2] }
end

--- Draws a supporting surface.
function hair_view.support(view, one, support)
    local edges = { support:edges() }
    for _, edge in ipairs(edges) do
        for i, point in ipairs(edge) do edge[i] = matrices.point(one.place, point) end
    end
    view:surface{ from = edges[1], to = edges[2], color = "#f0c040", opacity = 0.22 }
    for _, edge in ipairs(edges) do view:line{ points = edge, color = "#f0c040", width = 1 } end
end

--- Says something at the cursor; nothing for an empty text.
function hair_view.say(view, text)
    if not text or not view.cursor then return end
    local origin, direction = view.camera:ray(view.cursor[1] + 12, view.cursor[2] - 12, view.size)
    view:label{ at = vectors.plus(origin, direction, 1), text = text }
end

-- Pixels of a line, and how much of it is seen end-on: within 15 degrees of the line of sight.
local function how_seen(view, camera, points)
    local pixels, whole, on_end, last = 0, 0, 0, nil
    for i, point in ipairs(points) do
        local x, y = camera:project(point, view.size)
        local side = i > 1 and vectors.plus(point, points[i - 1], -1)
        if last and x == x then
            local _, sight = camera:ray(x, y, view.size)
            local length = vectors.length(side)
            pixels, whole = pixels + math.sqrt((x - last[1]) ^ 2 + (y - last[2]) ^ 2), whole + length
            if math.abs(vectors.dot(side, sight)) > 0.966 * length then on_end = on_end + length end
        end
        last = x == x and { x, y } or nil
    end
    return pixels, whole > 0 and on_end / whole or 0
end

--- Reason that makes strokes at a curve hard from here, in words; nil if there is none, or no curve.
function hair_view.warning(view, one, curve)
    if not curve or curve:kind() == "dividing" then return nil end
    local pixels, on_end = how_seen(view, hair.camera(view.camera, one), curve:course())
    if on_end > 1 / 3 then return "seen end-on: turn the view, or draw on the strip" end
    if pixels < 120 then return "come nearer to edit it" end
    return nil
end

-- How deep the slice of the field lies: over the head under the cursor, else in the middle of the head.
local function slice_depth(view, one, camera)
    local x, y = view.cursor[1], view.cursor[2]
    local hit = camera:pick{ mesh = one.scalp:head(), x = x, y = y, size = view.size }
    if hit then return hit.depth - 0.012 * one.scalp:scale() end
    local _, _, depth = camera:project(one.scalp:center(), view.size)
    return depth
end

local slice_steps, slice_step, arrow_length = 4, 0.012, 0.009       -- to each side; metres

-- An arrow of the picture from one pixel to another.
local function draw_arrow(view, from, to)
    local u, v = to[1] - from[1], to[2] - from[2]
    local left = { to[1] - 0.35 * u - 0.2 * v, to[2] - 0.35 * v + 0.2 * u }
    local right = { to[1] - 0.35 * u + 0.2 * v, to[2] - 0.35 * v - 0.2 * u }
    view:outline{ pixels = { from, to, left, to, right }, color = "#f4f4f4", width = 1.3, opacity = 0.8 }
end

--- Draws which way hair grows on a slice across the view that follows the cursor.
function hair_view.field(view, one)
    if not view.cursor or not hair.is_grown(one.style) then return end
    local camera, metre = hair.camera(view.camera, one), one.scalp:scale()
    local depth = slice_depth(view, one, camera)
    local middle = camera:unproject({ view.cursor[1], view.cursor[2], depth }, view.size)
    for i = -slice_steps, slice_steps do
        for k = -slice_steps, slice_steps do
            local side = vectors.plus(middle, camera:right(), i * slice_step * metre)
            local at = vectors.plus(side, camera:up(), k * slice_step * metre)
            local way, height = one.style:field(at)
            local tip = vectors.plus(at, way, arrow_length * metre)
            local x, y = camera:project(at, view.size)
            local u, v = camera:project(tip, view.size)
            if height > 0 and x == x and u == u then draw_arrow(view, { x, y }, { u, v }) end
        end
    end
end

return hair_view
