--- Common parts of tools that edit curves of a hairstyle: the chosen curve, its numbers in the panel, points
--- that are dragged along a line. Points are in the head's own space, lengths in metres of an average head.
local hair = require "tools.support.hair"
local hair_view = require "tools.support.hair_view"
local matrices = require "matrices"
local vectors = require "vectors"

local curve_handles = {}

--- From the curves of a kind, returns the wanted one if it still exists, else the last; its place, and all.
function curve_handles.chosen(one, kind, wanted)
    local list = hair.curves(one, kind)
    for i, curve in ipairs(list) do
        if curve == wanted then return curve, i, list end
    end
    return list[#list], #list, list
end

-- Factor from a parameter in millimetres to the unit of a curve's options.
local function unit_of(param) return param.unit == "millimetres" and 1 / 1000 or 1 end

--- Puts the options of a curve into the parameters of a group, as far as they may go.
function curve_handles.show(params, group, curve)
    local options = curve:options()
    for _, p in ipairs(params:schema()) do
        if p.group == group and options[p.name] then
            params[p.name] = math.max(p.min, math.min(p.max, options[p.name] / unit_of(p)))
        end
    end
end

--- The options of a curve that the parameters of a group set; only that of a name, if one is given.
function curve_handles.options(params, group, name)
    local options = {}
    for _, p in ipairs(params:schema()) do
        local is_asked = p.group == group and (name == nil or p.name == name)
        if is_asked then options[p.name] = p.value * unit_of(p) end
    end
    return options
end

-- Whether a handle can be slid: its path is not seen end-on, at which it would also lie on its base.
local function can_slide(camera, size, handle)
    local x, y = camera:project(handle.at, size)
    if x ~= x then return false end
    local _, sight = camera:ray(x, y, size)
    return math.abs(vectors.dot(handle.way, sight)) < 0.985
end

--- The handle under the cursor, within 12 pixels, of a list of { at = } and more.
function curve_handles.pick(ev, one, list)
    local camera, best, nearest = hair.camera(ev.camera, one), nil, 12
    for _, handle in ipairs(list) do
        local x, y = camera:project(handle.at, ev.size)
        local pixels = math.sqrt((x - ev.x) ^ 2 + (y - ev.y) ^ 2)
        if pixels <= nearest and can_slide(camera, ev.size, handle) then best, nearest = handle, pixels end
    end
    return best
end

--- Distance from its base of a handle { base =, way = } at the point of its path nearest to the cursor; the
-- path is of length 1.
function curve_handles.slide(ev, one, handle)
    local origin, seen = hair.camera(ev.camera, one):ray(ev.x, ev.y, ev.size)
    local from, slope = vectors.plus(origin, handle.base, -1), vectors.dot(handle.way, seen)
    local along = vectors.dot(from, handle.way) - slope * vectors.dot(from, seen)
    return along / math.max(1 - slope * slope, 0.01) / one.scalp:scale()
end

--- Draws handles, each with a line from its base; that under the cursor glows, and says its name.
function curve_handles.draw(view, one, list, held)
    local under = held or view.cursor and curve_handles.pick(hair_view.event(view), one, list)
    local camera, shown = hair.camera(view.camera, one), {}
    for _, handle in ipairs(list) do
        if can_slide(camera, view.size, handle) then shown[#shown + 1] = handle end
    end
    for _, handle in ipairs(shown) do
        hair_view.line(view, one, { handle.base, handle.at }, { color = "#e8a33d", width = 1 })
        local glows = under and under.option == handle.option
        view:handle{ at = matrices.point(one.place, handle.at), color = glows and "#ffd24a" or nil,
            radius = glows and 11 or 8 }
        if glows and not held then hair_view.say(view, handle.option) end
    end
    return under
end

--- A place on a line over the head, 0 to 1 along it, with its frame: { at =, tangent =, right =, normal = }.
function curve_handles.place_on(one, line, share)
    local place = 1 + share * (#line - 1)
    local i = math.min(math.floor(place), #line - 1)
    local side = vectors.plus(line[i + 1], line[i], -1)
    local at, tangent = vectors.plus(line[i], side, place - i), vectors.unit(side)
    local normal = one.scalp:head():nearest(at).normal
    local right = vectors.unit(vectors.cross(tangent, normal))
    return { at = at, tangent = tangent, right = right, normal = vectors.cross(right, tangent) }
end

--- Draws an arrow { at =, way =, normal = } of `length` (0.014) metres, flat to its normal.
function curve_handles.arrow(view, one, arrow, length)
    local across, metres = vectors.cross(arrow.normal, arrow.way), (length or 0.014) * one.scalp:scale()
    local tip = vectors.plus(arrow.at, arrow.way, metres)
    local barb = vectors.plus(arrow.at, arrow.way, 0.7 * metres)
    local left = vectors.plus(barb, across, 0.2 * metres)
    local right = vectors.plus(barb, across, -0.2 * metres)
    hair_view.line(view, one, { arrow.at, tip, left, tip, right }, { color = "#f0a040", width = 2 })
end

return curve_handles
