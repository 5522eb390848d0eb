--- Strokes of hairstyles: lists of points on and around a head, by directions, offsets and places in
--- millimetres of an average head, so that they fit any head.
--
--     local strokes = require "strokes"
--     local by, to = strokes.by, strokes.to
--     local route = strokes.route(style)
--     style:add_stream{ points = route{ { 20, 45, 10 }, { 72, 8, 20 }, by(4, -50, -4), to(80, -115, -20) } }
--
-- { azimuth, elevation, lift }: over the head in that direction, in degrees and millimetres.
-- by(x, y, z): as far from the point before. to(x, y, z): as far from the center of the head.
-- x is to the head's left, y up, z to the front.
local strokes = {}

function strokes.by(x, y, z) return { by = { x, y, z } } end

function strokes.to(x, y, z) return { to = { x, y, z } } end

-- A function that turns a list of such places into points of the style's head.
function strokes.route(style)
    local scalp = style:scalp()
    local function point(place, last)
        if place.to then
            return scalp:from_metres(place.to[1] / 1000, place.to[2] / 1000, place.to[3] / 1000)
        elseif place.by then
            local from = scalp:to_metres(last)
            return scalp:from_metres(from[1] + place.by[1] / 1000, from[2] + place.by[2] / 1000,
                from[3] + place.by[3] / 1000)
        end
        return style:at{ azimuth = place[1], elevation = place[2], lift = (place[3] or 0) / 1000 }
    end
    return function(places)
        local points = {}
        for i, place in ipairs(places) do points[i] = point(place, points[i - 1]) end
        return points
    end
end

-- The same places on the other side of the head.
function strokes.mirrored(places)
    local list = {}
    for i, place in ipairs(places) do
        if place.to then
            list[i] = strokes.to(-place.to[1], place.to[2], place.to[3])
        elseif place.by then
            list[i] = strokes.by(-place.by[1], place.by[2], place.by[3])
        else
            list[i] = { -place[1], place[2], place[3] }
        end
    end
    return list
end

-- Calls add(places) with each list, and with its mirror image.
function strokes.both_sides(lists, add)
    for _, places in ipairs(lists) do
        add(places)
        add(strokes.mirrored(places))
    end
end

return strokes
