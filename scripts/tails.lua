--- Ties and the ways of hair beyond them, for presets: braids and tails behind the head, or one on each side.
local hairdo = require "hairdo"
local lissom = require "lissom"
local styling = require "styling"

local tails = {}

-- The vector from the head to a place in metres, and its length.
local function off_head(scalp, p)
    local q = scalp:to_metres(scalp:head():nearest(scalp:from_metres(p)).position)
    local off = { p[1] - q[1], p[2] - q[2], p[3] - q[3] }
    return off, math.max(1e-6, math.sqrt(off[1] ^ 2 + off[2] ^ 2 + off[3] ^ 2))
end

--- The way down of a braid from its tie, `away` metres off the head as far as that reaches.
function tails.way_down(scalp, tie, length, away)
    local frame = { azimuth = tie.azimuth, elevation = tie.elevation, lift = tie.lift }
    local at, normal = scalp:at(frame), scalp:normal_at(frame)
    local p, tip = scalp:to_metres(at), {}
    for k = 1, 3 do tip[k] = at[k] + normal[k] * scalp:scale() end
    local to, d, points = scalp:to_metres(tip), {}, { at }
    for k = 1, 3 do d[k] = to[k] - p[k] end
    for i = 1, math.ceil(length / 0.004) do
        local off, far = off_head(scalp, p)
        local push = far > 0.05 and 0 or math.min(math.max((away - far) / 0.012, -0.6), 0.6)
        local v, size = {}, 0
        for k = 1, 3 do
            d[k] = d[k] + 0.22 * ((k == 2 and -1 or 0) - d[k])
            v[k] = d[k] + push * off[k] / far
            size = size + v[k] ^ 2
        end
        for k = 1, 3 do p[k] = p[k] + 0.004 * v[k] / math.sqrt(size) end
        if i % 2 == 0 then points[#points + 1] = scalp:from_metres(p) end
    end
    return points
end

--- The ring of the tie at the end of a braid: around the point of its spine `length` on. Lengths are those of
-- the braid, in metres of its hair.
function tails.end_ring(scalp, spine, length, radius)
    local far, unit = 0, scalp:unit()
    for i = 2, #spine do
        local a, b, d, step = spine[i - 1], spine[i], {}, 0
        for k = 1, 3 do
            d[k] = b[k] - a[k]
            step = step + d[k] ^ 2
        end
        step = math.sqrt(step)
        far = far + step * unit
        if far >= length or i == #spine then
            local back, center = math.max(far - length, 0) / unit, {}
            for k = 1, 3 do
                d[k] = d[k] / step
                center[k] = b[k] - back * d[k]
            end
            local average = unit * scalp:scale()
            return hairdo.ring_around(scalp, center, d, radius / average, 0.0026 / average)
        end
    end
end

--- The way of a braid from its tie behind the ear over the shoulder to the front, `away` metres off the head.
function tails.way_over_shoulder(scalp, tie, away)
    local side = tie.azimuth < 0 and -1 or 1
    local points = styling.route(scalp, { { side * tie.azimuth, tie.elevation, 1000 * tie.lift },
        { side * tie.azimuth, tie.elevation, 1000 * tie.lift + 5 }, { "at", 72, -52, -40 },
        { "at", 76, -85, -18 }, { "at", 76, -120, 16 }, { "at", 74, -160, 48 },
        { "at", 72, -210, 62 }, { "at", 70, -270, 66 }, { "at", 70, -420, 66 } }, side)
    for i = 2, #points do
        local p = scalp:to_metres(points[i])
        local off, far = off_head(scalp, p)
        if far < away then
            for k = 1, 3 do p[k] = p[k] + (away - far) * off[k] / far end
            points[i] = scalp:from_metres(p)
        end
    end
    return points
end

--- The angle in degrees by which a point in metres of the scalp's frame lies beside the middle of the head.
function tails.across(p)
    return math.deg(math.asin(p[1] / math.sqrt(p[1] ^ 2 + p[2] ^ 2 + p[3] ^ 2)))
end

-- Azimuth and elevation `along` degrees over the head in the row `across` degrees beside its middle.
local function place_in_row(across, along)
    local a, t = math.rad(across), math.rad(along)
    return styling.angles{ math.sin(a), math.cos(a) * math.sin(t), math.cos(a) * math.cos(t) }
end

--- The middle of a row of hair from the forehead over the head to the nape, `across` degrees beside the
-- middle, in the unit of the head, and on as a tail of so many metres.
function tails.row(scalp, across, tail)
    local points, last = {}, 215 - 0.43 * math.abs(across)
    for along = 34, last, 5 do
        local azimuth, elevation = place_in_row(across, along)
        points[#points + 1] = scalp:at{ azimuth = azimuth, elevation = elevation,
            lift = 0.0003 + 0.0027 * styling.smooth(34, 90, along) }
    end
    local q = scalp:to_metres(points[#points])
    for j = 1, 6 do
        points[#points + 1] = scalp:from_metres{ q[1] * (1 + 0.02 * j), q[2] - tail * j / 6,
            q[3] * (1 + 0.01 * j) - 0.006 * math.min(j, 2) }
    end
    return points
end

-- Ways of hair to a tie at one side.
local function leads(side)
    return { { { side * 6, 42 }, { side * 40, 50 }, { side * 78, 36 }, { side * 108, 20 } },
        { { side * 8, 70 }, { side * 80, 66 }, { side * 118, 36 } },
        { { side * 170, 60 }, { side * 155, 30 } }, { { side * 172, -2 }, { side * 158, -6 } },
        { { side * 172, -32 }, { side * 156, -24 } },
        { { side * 68, 8 }, { side * 78, 20 }, { side * 92, 24 }, { side * 112, 10 } } }
end

--- A style of two tails from a parting down the middle to the nape, and the two ties. `tie` has the azimuth,
-- elevation, lift, radius, droop and length of the left one, as hairdo.tail_spine takes them.
function tails.both_sides(head, o, tie)
    local style = lissom.hairstyle(head, { scalp = o.scalp,
        gravity = 0, resolution = math.floor(1.2 * o.resolution) })
    style:add_dividing{ points = styling.route(o.scalp, { { 0, 37 }, { 0, 60 }, { 0, 86 }, { 180, 60 },
        { 180, 20 }, { 180, -20 } }), tilt = { 20, 20 }, height = 0 }
    local ties = {}
    for side = 1, -1, -2 do
        local own = {}
        for key, value in pairs(tie) do own[key] = value end
        own.azimuth = side * tie.azimuth
        hairdo.keep_off_ears(o.scalp, own)
        hairdo.gather(style, own, { count = 10, reach = 0.07, low = 0.006,
            skip = function(azimuth) return azimuth * side < 2 end })
        hairdo.lead(style, own, { routes = leads(side), low = 0.006 })
        style:add_ponytail{ spine = hairdo.tail_spine(o.scalp, own), radius = own.radius, share = 0.7,
            fullness = tie.fullness, tail_length = tie.tail_length, name = "tail " .. #ties + 1 }
        ties[#ties + 1] = own
    end
    return style, ties
end

return tails
