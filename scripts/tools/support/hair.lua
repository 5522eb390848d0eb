--- A hairstyle in a tool's hand: the style that is in the scene, the curve under the cursor, and the strands,
-- an object "<name of the style> hair" beside it.
local lissom = require "lissom"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"
local vectors = require "vectors"

local hair = {}

--- Parameters of a tool that grows hair.
hair.params = {
    strands = { type = "integer", default = 5000, min = 0, max = 200000, group = "hair",
        help = "How many strands follow the curves." },
    length = { type = "number", default = 0.25, min = 0.01, max = 1, unit = "metres", group = "hair",
        help = "Length of the strands, on an average head." },
    cut = { type = "number", default = 1, min = -0.2, max = 1, unit = "metres", group = "hair",
        help = "Hair ends so far below the middle of the head, but for tails; at 1 it is not cut." },
    slant = { type = "number", default = 0, min = -45, max = 45, unit = "degrees", group = "hair",
        help = "Tilt of the cut: lower at the head's left, or if negative, at its right." },
    field = { type = "boolean", default = false, group = "hair",
        help = "Arrows around the cursor: which way hair grows there." },
}

--- A parameter of tools that may draw on both sides.
hair.symmetric = { type = "boolean", default = false, help = "The other side of the head follows." }

--- The parameters of a tool with those above.
function hair.with_params(own)
    local all = {}
    for _, list in ipairs{ hair.params, own } do
        for name, param in pairs(list) do all[name] = param end
    end
    return all
end

--- The first visible hairstyle of a scene: { name =, style =, scalp =, place =, strands =, length = }, with
-- the matrix from the head's own space to the world, and values of `params`; nil if there is none.
function hair.find(scene, params)
    for _, name in ipairs(scene:names()) do
        local info = scene:info(name)
        if info.kind == "hairstyle" and info.visible then
            local style = scene:get(name)
            return { name = name, style = style, scalp = style:scalp(), place = info.transform,
                strands = params and params.strands or hair.params.strands.default,
                length = params and params.length or hair.params.length.default,
                cut = params and params.cut or hair.params.cut.default,
                slant = params and params.slant or hair.params.slant.default }
        end
    end
    return nil
end

local room = { min = { -0.24, -0.42, -0.3 }, max = { 0.24, 0.22, 0.18 } }     -- for tails and long hair
local surely = 0.5              -- confidence from which a mesh is taken for a head

-- Begins a hairstyle on a head: the only mesh that is to be seen, or the one of which something is selected.
local function begin(scene)
    local one = meshes.subject(scene)
    local scalp = lissom.try(lissom.scalp, one and one.mesh)
    if not scalp or scalp:confidence() < surely then
        error("no hairstyle is to be seen, and no mesh that is surely a head" .. (one and "" or ", alone")
            .. ": add one, as scene:add('style', lissom.hairstyle(head))", 0)
    end
    local style = lissom.hairstyle(one.mesh, { scalp = scalp, volume = room })
    local name = meshes.unused_name(scene, one.name .. " style")
    scene:add(name, style, { transform = one.place })
    return name
end

--- Finds the same; if there is none a style is begun on the visible head, and `begun` is its name. Without a
-- head it raises an error with a remedy.
function hair.need(scene, params)
    local name = not hair.find(scene) and begin(scene) or nil
    local one = hair.find(scene, params)
    one.begun = name
    return one
end

--- A camera that sees the head's own space as `camera` sees the world.
function hair.camera(camera, one)
    local back, ortho = matrices.inverse(one.place), camera:ortho()
    local up = matrices.direction(back, camera:up())
    local scale = math.sqrt(up[1] ^ 2 + up[2] ^ 2 + up[3] ^ 2)
    return lissom.camera{ eye = matrices.point(back, camera:eye()), up = up, fov = camera:fov(),
        target = matrices.point(back, camera:target()), ortho = ortho and ortho * scale }
end

--- Curves of a style, of one kind if that is given.
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

--- The place of a line seen nearest to a pixel: { pixels =, segment =, along =, point = }, of points of the
-- head's own space; nil if it is not in front of the camera.
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

--- Whether the head hides a point from a camera.
function hair.is_hidden(one, camera, size, point)
    local x, y, depth = camera:project(point, size)
    local hit = camera:pick{ mesh = one.scalp:head(), x = x, y = y, size = size }
    return hit ~= nil and hit.depth < depth - 0.01 * one.scalp:scale()
end

local near_line, near_end, as_near = 10, 14, 4       -- pixels

-- The place of a curve under the cursor, as hair.nearest; its ends from farther away, and before other
-- curves.
local function place_under(ev, camera, curve, radius)
    local points = curve:course()
    local near = hair.nearest(points, camera, ev.size, ev.x, ev.y)
    if not near then return nil end
    near.weighed = near.pixels
    for _, i in ipairs{ #points, 1 } do
        local x, y = camera:project(points[i], ev.size)
        local off = math.sqrt((x - ev.x) ^ 2 + (y - ev.y) ^ 2)
        if off <= near_end then
            return { pixels = off, segment = math.max(i - 1, 1), along = i == 1 and 0 or 1, point = points[i],
                weighed = off - near_end }
        end
    end
    return near.pixels <= radius and near or nil
end

--- The curves under the cursor that the head does not hide, the nearest first: a list of { curve =, at = as
-- hair.nearest }. `kind` as in hair.curves; `preferred` counts as nearer by 4 pixels; lines are hit from
-- `radius` (10) pixels away, ends from 14.
function hair.curves_at(ev, one, options)
    options = options or {}
    local camera, list = hair.camera(ev.camera, one), {}
    for i, curve in ipairs(hair.curves(one, options.kind)) do
        local at = place_under(ev, camera, curve, options.radius or near_line)
        if at and not hair.is_hidden(one, camera, ev.size, at.point) then
            at.weighed = at.weighed - (curve == options.preferred and as_near or 0)
            list[#list + 1] = { curve = curve, at = at, order = i }
        end
    end
    table.sort(list, function(a, b)
        if a.at.weighed ~= b.at.weighed then return a.at.weighed < b.at.weighed end
        return a.order < b.order
    end)
    return list
end

--- The first of these, and its place; nil if there is none.
function hair.curve_at(ev, one, options)
    local first = hair.curves_at(ev, one, options)[1]
    if not first then return nil end
    return first.curve, first.at
end

--- The curve that the tab key chooses after another one: the next of several under the cursor, else the next
-- of its kind.
function hair.next_curve(ev, one, kind, curve)
    local list = {}
    for _, found in ipairs(ev.x and hair.curves_at(ev, one, { kind = kind }) or {}) do
        list[#list + 1] = found.curve
    end
    if #list < 2 then list = hair.curves(one, kind) end
    for i, other in ipairs(list) do
        if other == curve then return list[i % #list + 1] end
    end
    return list[1]
end

--- Whether a style has curves that act.
function hair.is_grown(style)
    for _, curve in ipairs(style:curves()) do
        if curve:enabled() then return true end
    end
    return false
end

--- The plane that cuts the hair of a style, as style:grow takes it; nil if it is not cut.
function hair.cut(one)
    if one.cut >= hair.params.cut.max then return nil end
    local normal, slant = {}, math.rad(one.slant)
    for k = 1, 3 do
        normal[k] = -math.cos(slant) * one.scalp:up()[k] - math.sin(slant) * one.scalp:left()[k]
    end
    return { point = one.scalp:from_metres(0, -one.cut, 0), normal = normal }
end

-- Metres: as wide as hair for as many strands as hairs, and wider the fewer there are, so that they cover the
-- head; not so wide that they look like ribbons.
local function width_of(count)
    return 75e-6 * math.max(1, math.min(8, (100000 / math.max(count, 1)) ^ (2 / 3)))
end

--- The strands of a style in the scene; nil if none have grown.
function hair.strands(scene, one) return meshes.object(scene, one.name .. " hair") end

--- Grows the strands of a style, or a share of them during a drag, into the object "<name> hair", which is
-- added if it is missing, and removed with the last curve.
function hair.grow(scene, one, share)
    local name = one.name .. " hair"
    local old = meshes.object(scene, name)
    local kind = old and scene:info(name).kind
    if old and kind ~= "strands" then
        error("'" .. name .. "' is a " .. kind .. ": rename it, hair goes by that name", 0)
    end
    if not hair.is_grown(one.style) then
        if old then scene:remove(name) end
        return nil
    end
    local count = math.floor(one.strands * (share or 1))
    local strands = one.style:grow{ count = count, length = one.length, cut = hair.cut(one), into = old }
    strands:set_widths{ width = width_of(count) }
    if not old then scene:add(name, strands, { transform = one.place }) end
    return strands
end

--- Tries the same: returns true and `said`, or false and the reason.
function hair.try_grow(scene, one, share, said)
    local done, message = pcall(hair.grow, scene, one, share)
    return done, done and said or message
end

local fine, step = 0.5, 2       -- pixels from the last one from which an event counts, and from which it acts

--- A stroke that begins: its `pixels`, how often Alt was pressed in it, its `turn`, and the style that was
-- `begun` for it. A tool keeps one while the button is down, with all that is known of it.
function hair.new_stroke(ev, one)
    return { pixels = { { ev.x, ev.y } }, turn = 0, alt = ev.alt, begun = one.begun }
end

--- After a click, which draws nothing: a style that was begun for it goes again.
function hair.forget_begun(stroke, scene)
    if stroke.begun and meshes.object(scene, stroke.begun) then scene:remove(stroke.begun) end
end

--- Message of an error, without its place in a script and its code.
function hair.message(problem)
    if type(problem) == "table" and problem.message then return problem.message end
    return (tostring(problem):gsub("^[^\n]-:%d+: ", ""))
end

--- The code of an error; nil if a script has raised a text.
function hair.code(problem) return type(problem) == "table" and problem.code or nil end

--- Text about a stroke: `said` if it was `done`, else its fault, and if it starts beside the head and changes
-- no curve, other readings.
function hair.told(done, said, is_change)
    local text = hair.message(said)
    if done or is_change or hair.code(said) ~= "out_of_range" then return text end
    return text .. ", or click a curve first to change that"
end

local function is_near(ev, pixel, pixels)
    return pixel and math.abs(ev.x - pixel[1]) + math.abs(ev.y - pixel[2]) < pixels
end

--- Takes an event into the stroke; whether there is anything to be done about it, so that slow hands with
-- thousands of events do not wait for each.
function hair.goes_on(stroke, ev)
    local is_turned, pixels = ev.alt and not stroke.alt, stroke.pixels
    if is_turned then stroke.turn = stroke.turn + 1 end
    stroke.alt = ev.alt
    if not is_near(ev, pixels[#pixels], fine) then table.insert(pixels, { ev.x, ev.y }) end
    if is_near(ev, stroke.last, step) and not is_turned and not stroke.behind then return false end
    stroke.last, stroke.behind = { ev.x, ev.y }, ev.late
    return not ev.late
end

--- Whether a stroke is a click: all of it within 6 pixels.
function hair.is_click(pixels)
    for _, pixel in ipairs(pixels) do
        if math.abs(pixel[1] - pixels[1][1]) + math.abs(pixel[2] - pixels[1][2]) > 6 then return false end
    end
    return true
end

--- Advice of a tool after the step that now ends, if any: the `text`, and the position of the hand.
function hair.advice_after(ev, text)
    return text and { text = text, step = ev.scene:history().place + 1, x = ev.x, y = ev.y } or nil
end

local advised_near = 60         -- pixels

--- The text of a tool's advice, until another step is done or this one undone, or the hand goes elsewhere.
function hair.advice(tool, view)
    local advice, cursor = tool.advice, view.cursor
    if not advice or not cursor or view.scene:history().place ~= advice.step then return nil end
    local away = math.max(math.abs(cursor[1] - advice.x), math.abs(cursor[2] - advice.y))
    if away > advised_near then tool.advice = nil end
    return advice.text
end

--- Text of tools for strokes of uncertain depth.
hair.guessed = "off the head its depth is a guess: click it, turn the view by 90 degrees, draw it again"

--- The same for a stroke much of which is beside the head; nil if it is not.
function hair.is_guess(ev, one, pixels)
    local camera, beside = hair.camera(ev.camera, one), 0
    for _, pixel in ipairs(pixels) do
        local hit = camera:pick{ mesh = one.scalp:head(), x = pixel[1], y = pixel[2], size = ev.size }
        if not hit then beside = beside + 1 end
    end
    if beside < 0.25 * #pixels then return nil end
    return hair.guessed
end

local seen_only = { field = true, surface = true, stop = true, reach = true, by = true, symmetric = true,
    lift = true }

--- Whether a parameter changes the picture, or the next stroke, but no hair.
function hair.is_seen_only(parameter) return seen_only[parameter] == true end

--- The place that hair.nearest has found, or the first point if it is near that: there a curve is held by its
-- root.
function hair.snapped(near, points)
    if near.segment ~= 1 or near.along > 0.5 then return near.point end
    near.along = 0
    return points[1]
end

return hair
