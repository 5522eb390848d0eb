--- Common parts of presets of hairstyles: routes of streams in directions over the head, functions of the
-- place on the head, and the frame of a preset that runs as a script too.
--
-- A route is a list of places in millimetres of an average head: { azimuth, elevation, lift } over the head;
-- { "by", x, y, z } from the place before; { "at", x, y, z } from the middle of the head. x points to the
-- head's left, y up, z to the front. The route of the other side is added, unless the route has `one = true`
-- or lies in the middle.
local hairdo = require "hairdo"
local lissom = require "lissom"

local styling = {}

-- With two arguments in every Lua.
local atan2 = rawget(math, "atan2") or math.atan

--- The colour of hair as "#rrggbb", from its melanin, 0 white to 1 black, the part of it that is red
-- (pheomelanin), and the part of grey hair. Both melanins absorb red, green and blue as in Chiang et al.
-- (2016); the power is between that of a single strand, 1, and that of their fit of dense hair, 0.5.
function styling.color(melanin, redness, grey)
    local amount = -math.log(1 - math.min(math.max(melanin, 0), 0.98))
    local brown, red = amount * (1 - (redness or 0)), amount * (redness or 0)
    local parts = {}
    for k, absorbed in ipairs{ { 0.506, 0.343 }, { 0.841, 0.733 }, { 1.653, 1.924 } } do
        local left = 0.012 + 0.83 * math.exp(-3.1 * (brown * absorbed[1] + red * absorbed[2]) ^ 0.65)
        left = left + (grey or 0) * (0.55 - left)
        local shown = left <= 0.0031308 and 12.92 * left or 1.055 * left ^ (1 / 2.4) - 0.055
        parts[k] = math.floor(255 * math.min(math.max(shown, 0), 1) + 0.5)
    end
    return string.format("#%02x%02x%02x", parts[1], parts[2], parts[3])
end

--- Usual colours by their names.
styling.colors = {
    black = styling.color(0.95), dark_brown = styling.color(0.75, 0.05), brown = styling.color(0.5, 0.08),
    light_brown = styling.color(0.33, 0.1), dark_blond = styling.color(0.22, 0.1),
    blond = styling.color(0.13, 0.15), platinum = styling.color(0.04, 0.05),
    auburn = styling.color(0.55, 0.6), red = styling.color(0.5, 1), grey = styling.color(0.8, 0, 0.5),
    white = styling.color(0.01),
}

--- Red, green and blue of a colour "#rrggbb" as hair:set_colors takes them.
function styling.linear(color)
    local made = {}
    for part in color:gmatch("%x%x") do
        local x = tonumber(part, 16) / 255
        made[#made + 1] = x <= 0.04045 and x / 12.92 or ((x + 0.055) / 1.055) ^ 2.4
    end
    return made
end

--- Colours a preset's hair from root to tip by names of styling.colors, or "#rrggbb", two or more.
function styling.ombre(hair, ...)
    local profile = {}
    for i, color in ipairs{ ... } do profile[i] = styling.linear(styling.colors[color] or color) end
    return hair:set_colors{ profile = profile }
end

--- A random number from 0 to 1 of a number, such as that of a strand or a lock.
function styling.chance(number, seed)
    local x = math.sin(12.9898 * number + 78.233 * seed) * 43758.5453
    return x - math.floor(x)
end

--- Streaks: a part of the locks, 0 to 1, has another colour.
function styling.highlights(hair, base, streaks, part, seed)
    local colors = {}
    local a = styling.linear(styling.colors[base] or base)
    local b = styling.linear(styling.colors[streaks] or streaks)
    for s = 1, #hair do
        local root = hair:root(s)
        colors[s] = styling.chance(root.guide or root.id, seed or 1) < part and b or a
    end
    return hair:set_colors{ colors = colors }
end

--- 0 up to `low`, 1 from `high` on, level at both.
function styling.smooth(low, high, x)
    local t = math.min(math.max((x - low) / (high - low), 0), 1)
    return t * t * (3 - 2 * t)
end

--- Azimuth and elevation in degrees of a point in metres of the scalp's frame.
function styling.angles(p)
    local r = math.sqrt(p[1] ^ 2 + p[2] ^ 2 + p[3] ^ 2)
    return math.deg(atan2(p[1], p[3])), math.deg(math.asin(p[2] / r))
end

--- A function of vertices, for the lengths and the density of style:grow, of f(azimuth, elevation, place).
function styling.by_angles(scalp, f)
    return function(_, x, y, z)
        local p = scalp:to_metres(x, y, z)
        local azimuth, elevation = styling.angles(p)
        return f(azimuth, elevation, p)
    end
end

--- The place in metres `lift` millimetres off the head, straight from its middle: normals of a bumpy head
-- would scatter hair that stands far off it.
function styling.off(scalp, azimuth, elevation, lift)
    local p, size = scalp:to_metres(scalp:at{ azimuth = azimuth, elevation = elevation }), 0
    for k = 1, 3 do size = size + p[k] ^ 2 end
    for k = 1, 3 do p[k] = p[k] * (1 + 0.001 * lift / math.sqrt(size)) end
    return p
end

--- The points of a route, or with `side` -1 those of its mirror image.
function styling.route(scalp, places, side)
    local points, last = {}, nil
    side = side or 1
    for i, place in ipairs(places) do
        if place[1] == "by" then
            last = { last[1] + side * place[2] / 1000, last[2] + place[3] / 1000, last[3] + place[4] / 1000 }
        elseif place[1] == "at" then
            last = { side * place[2] / 1000, place[3] / 1000, place[4] / 1000 }
        else
            last = scalp:to_metres(scalp:at{ azimuth = side * place[1], elevation = place[2],
                lift = (place[3] or 0) / 1000 })
        end
        points[i] = scalp:from_metres(last)
    end
    return points
end

local function in_the_middle(route)
    for _, place in ipairs(route) do
        local across = type(place[1]) == "string" and place[2] or place[1] % 180
        if math.abs(across) > 1e-6 then return false end
    end
    return true
end

--- A mask for operators: `low` for strands rooted below the elevation `from`, 1 above `to`; degrees.
-- Locks that are seen from their ends, as at the nape, lie like scales if they gather as much as on top.
function styling.less_below(scalp, low, from, to)
    local unit = scalp:unit()
    return function(_, x, y, z)
        local _, elevation = styling.angles(scalp:to_metres(x / unit, y / unit, z / unit))
        return low + (1 - low) * styling.smooth(from, to, elevation)
    end
end

--- Adds streams along routes; `stop` of a route is that of style:add_stream.
function styling.streams(style, routes)
    for _, route in ipairs(routes) do
        for side = 1, (route.one or in_the_middle(route)) and 1 or -1, -2 do
            style:add_stream{ points = styling.route(style:scalp(), route, side), stop = route.stop }
        end
    end
end

--- Adds short streams of hair that is combed from one direction to another: { azimuth, elevation, azimuth,
-- elevation, lift at the end }.
function styling.comb(style, list)
    local routes = {}
    for i, c in ipairs(list) do
        routes[i] = { { c[1], c[2], 2 }, { (c[1] + c[3]) / 2, (c[2] + c[4]) / 2, 0.6 * c[5] },
            { c[3], c[4], c[5] }, one = c.one }
    end
    styling.streams(style, routes)
end

--- Adds streams that stand off the head all around, `length` millimetres long; their ends are `rise` degrees
-- higher than their roots. With a rise they hang down at the nape, where locks would be seen from their ends.
function styling.radial(style, length, rise)
    local function at(azimuth, elevation, lift)
        local p = styling.off(style:scalp(), azimuth, elevation, lift)
        return { "at", 1000 * p[1], 1000 * p[2], 1000 * p[3] }
    end
    local places = { { 0, 88 }, { 0, 60 }, { 60, 60 }, { 120, 60 }, { 180, 60 } }
    for azimuth = 0, 180, 30 do places[#places + 1] = { azimuth, 35 } end
    for azimuth = 60, 180, 30 do places[#places + 1] = { azimuth, 8 } end
    for azimuth = 120, 180, 30 do places[#places + 1] = { azimuth, -22 } end
    local routes = {}
    for i, p in ipairs(places) do
        local up = rise and rise - (rise + 24) * (1 - styling.smooth(-30, 50, p[2])) or 0
        routes[i] = { at(p[1], p[2], 2), at(p[1], p[2] + up / 2, length / 2), at(p[1], p[2] + up, length) }
    end
    styling.streams(style, routes)
end

--- Adds streams of a standing fin so many metres wide: from the middle and both of its edges up into one
-- plane, in even steps around the head; across it in metres, as azimuths mean little near the crown.
function styling.fin(style, width)
    local function place(turn, lift, across)
        local azimuth, elevation = turn > 90 and 180 or 0, turn > 90 and 180 - turn or turn
        local p = styling.off(style:scalp(), azimuth, elevation, lift)
        return { "at", 1000 * across * width, 1000 * p[2], 1000 * p[3] }
    end
    for turn = 36, 216, 12 do
        local up = 0.06 * (90 - turn)
        for _, edge in ipairs{ 0, 0.48 } do
            styling.streams(style, { { place(turn, edge == 0 and 2 or -2, edge),
                place(turn + up, 40, 0.75 * edge), place(turn + 1.5 * up, 110, 0.5 * edge), stop = false } })
        end
    end
end

-- Long hair behind the shoulders, and before them. Behind them it narrows, deepest in the middle.
styling.behind = {
    { { 12, 50, 9 }, { 30, 40, 16 }, { 50, 24, 19 }, { 66, 6, 22 }, { "at", 90, -60, 22 }, { "at", 82, -115,
        -20 }, { "at", 76, -170, -78 }, { "at", 72, -220, -100 }, { "at", 56, -380, -102 } },
    { { 30, 72, 10 }, { 66, 50, 18 }, { 84, 22, 23 }, { 92, 2, 29 }, { "at", 96, -60, -18 }, { "at", 76, -120,
        -58 }, { "at", 64, -190, -104 }, { "at", 46, -380, -110 } },
    { { 120, 70, 10 }, { 118, 40, 17 }, { 122, -5, 18 }, { "at", 70, -80, -66 }, { "at", 54, -130, -84 },
        { "at", 45, -190, -110 }, { "at", 32, -380, -120 } },
    { { 150, 66, 8 }, { 152, 30, 16 }, { 154, -28, 18 }, { "at", 34, -130, -90 }, { "at", 28, -200, -114 },
        { "at", 20, -380, -128 } },
    { { 180, 70, 8 }, { 180, 30, 16 }, { 180, -30, 18 }, { "at", 0, -130, -94 }, { "at", 0, -200, -116 },
        { "at", 0, -380, -132 } },
}
styling.over_shoulders = {
    { { 10, 50, 10 }, { 30, 40, 18 }, { 52, 25, 20 }, { 68, 5, 20 }, { "at", 80, -60, 20 },
        { "at", 80, -115, 6 }, { "at", 80, -180, 4 }, { "at", 82, -300, 10 } },
    { { 30, 72, 12 }, { 66, 50, 20 }, { 84, 18, 20 }, { 90, 0, 20 }, { "at", 88, -60, -6 },
        { "at", 84, -116, -24 }, { "at", 86, -180, -24 }, { "at", 86, -300, -20 } },
    { { 120, 70, 10 }, { 116, 40, 18 }, { 118, 5, 20 }, { "at", 74, -60, -60 }, { "at", 70, -115, -70 },
        { "at", 66, -190, -104 }, { "at", 62, -360, -112 } },
    { { 150, 66, 8 }, { 150, 30, 18 }, { 150, -10, 20 }, { "at", 44, -70, -84 }, { "at", 40, -130, -92 },
        { "at", 38, -200, -108 }, { "at", 36, -360, -114 } },
    { { 180, 70, 8 }, { 180, 30, 18 }, { 180, -10, 20 }, { "at", 0, -80, -88 }, { "at", 0, -130, -94 },
        { "at", 0, -200, -110 }, { "at", 0, -360, -116 } },
}

--- A style of long hair: `routes` of its streams, and the places of its `parting` or none.
function styling.long(head, o, routes, parting)
    local style = lissom.hairstyle(head, { scalp = o.scalp,
        gravity = 0, resolution = math.floor(1.2 * o.resolution),
        volume = { min = { -0.15, -0.42, -0.19 }, max = { 0.15, 0.16, 0.16 } } })
    if parting then
        style:add_dividing{ points = styling.route(o.scalp, parting), tilt = { 15, 0 } }
    end
    styling.streams(style, routes)
    return style
end

--- Cuts hair along a hem, as hair:cut takes it, in locks that end within `ragged` metres of it; nearly
--- half of the hairs are layers that end higher, so that the hair thins out. Guides stay the longest of their
--- locks.
function styling.ragged_hem(hair, scalp, hem, ragged, seed)
    local higher = {}
    for i, place in ipairs(hem) do higher[i] = { place[1], place[2] + 2.5 * ragged } end
    local function follows(strand) return hair:root(strand).guide ~= hair:root(strand).id end
    local function is_layer(strand) return follows(strand) and styling.chance(strand, seed) < 0.45 end
    hair:cut{ hem = hem, scalp = scalp, guide_jitter = 0.7 * ragged, seed = seed }
    hair:cut{ hem = hem, scalp = scalp, jitter = 0.4 * ragged, guide_jitter = 0.7 * ragged, seed = seed,
        mask = function(strand) return follows(strand) and 1 or 0 end }
    return hair:cut{ hem = higher, scalp = scalp, jitter = 2.5 * ragged, seed = seed + 1,
        mask = function(strand) return is_layer(strand) and 1 or 0 end }
end

--- Waves of long hair that ends at one height, in locks; `options` are those of hair:wave. Turns are counted
-- from the ends, so that crests of long and short hair lie together: counted from the roots, those of layers
-- would cross, and all would begin at one height, in a band.
function styling.loose_waves(hair, scalp, options)
    local unit = scalp:unit()
    local function begin(strand, x, y, z)
        local p = scalp:to_metres(x / unit, y / unit, z / unit)
        local sway = 0.22 * math.sin(48 * p[1] + 0.6) + 0.16 * math.sin(20 * p[1] + 70 * p[2] - 40 * p[3])
        return sway - hair:root(strand).arc / options.wavelength
    end
    local all = { begin = begin, start = 0.06, ramp = 0.16, variation = 0.08, depth = 0.8,
        keep_length = false }
    for key, value in pairs(options) do all[key] = value end
    return hair:wave(all)
end

--- Loose waves of grown long hair in locks, cut `length` metres below the middle of the head: none hangs over
-- the face. `options` has `locks`, their number, `factor` of hair:gather, `ragged` of the ends, `clump`, the
-- strength of finer locks, and `wave`, the options of styling.loose_waves.
function styling.wavy(hair, scalp, length, options)
    hair:resample{ step = 0.006 }:smooth{ iterations = 4 }
    hair:cull{ mask = styling.over_face(scalp, hair) }
    hair:cut{ hem = { { 0, -length - 0.01 } }, scalp = scalp }
    hair:gather{ guides = options.locks, factor = options.factor, ramp = 0.2, spread = 0.006 }
    styling.loose_waves(hair, scalp, options.wave)
    styling.ragged_hem(hair, scalp, { { 0, -length } }, options.ragged, options.wave.seed)
    return hair:clump{ clumps = 420, strength = options.clump or 0.6, shape = 1.5, tip_spread = 0.002 }
end

--- Straight long hair of a style: grown, in locks, cut `length` metres below the middle of the head, lowest
-- in the middle of the back. `options` are further ones of style:grow.
function styling.straight(style, o, v, options)
    local growth = { count = o.count, seed = v.seed, length = 0.245 + v.length, layer = v.volume,
        clearance = 0.003 }
    for key, value in pairs(options or {}) do growth[key] = value end
    local hair = style:grow(growth)
    hair:resample{ step = 0.006 }:smooth{ iterations = 4 }:guides{ count = 240 }
    hair:gather{ factor = 0.3, ramp = 0.25, spread = 0.005, seed = v.seed }
    local hem = {}
    for azimuth = 0, 180, 6 do
        hem[#hem + 1] = { azimuth, -v.length + 0.04 * (1 - styling.smooth(135, 178, azimuth)) }
    end
    styling.ragged_hem(hair, o.scalp, hem, v.ragged, v.seed)
    hair:clump{ strength = 0.6, shape = 3, tip_spread = 0.002, seed = v.seed }
    hair:clump{ clumps = 1200, strength = 0.4, seed = v.seed }
    return styling.finish(hair, 0.00028, 0.004):push_out{ head = style, clearance = 0.002 }
end

--- Parameters of straight long hair; `length` is the usual one.
function styling.straight_schema(length)
    return {
        length = { type = "number", default = length, min = 0.08, max = 0.34, unit = "metres",
            help = "of the ends below the middle of the head" },
        volume = { type = "number", default = 0.01, min = 0.002, max = 0.02, unit = "metres",
            help = "thickness of the hair" },
        ragged = { type = "number", default = 0.018, min = 0, max = 0.04, unit = "metres",
            help = "of the ends" },
    }
end

-- How short hair lies: from one whorl behind the crown to the hairline, forwards on top and at the sides,
-- down at the back. Streams that end on the way would stop the hair beyond them, in a ledge.
styling.crown_to_hairline = {
    { { 180, 65, 2 }, { 0, 86, 6 }, { 0, 70, 7 }, { 0, 54, 7 }, { 0, 40, 6 }, { 0, 26, 4 } },
    { { 173, 65, 2 }, { 72, 72, 6 }, { 34, 60, 7 }, { 26, 47, 7 }, { 22, 36, 6 }, { 20, 22, 4 } },
    { { 169, 63, 2 }, { 92, 60, 6 }, { 64, 48, 6 }, { 50, 37, 6 }, { 44, 27, 5 }, { 40, 12, 4 } },
    { { 168, 61, 2 }, { 104, 46, 5 }, { 84, 29, 5 }, { 73, 12, 4 }, { 68, -6, 3 } },
    { { 169, 59, 2 }, { 122, 36, 5 }, { 106, 16, 5 }, { 96, -4, 4 }, { 92, -24, 3 } },
    { { 172, 57, 2 }, { 138, 26, 5 }, { 129, 4, 5 }, { 126, -20, 4 }, { 126, -40, 3 } },
    { { 176, 56, 2 }, { 158, 20, 5 }, { 154, -8, 5 }, { 152, -40, 3 } },
    { { 180, 56, 2 }, { 180, 22, 5 }, { 180, -8, 5 }, { 180, -42, 3 } },
}

--- Density of short hair at an azimuth and elevation: at the sides and the nape it fades out downwards, by a
-- part of it at their hairline.
function styling.fade(azimuth, elevation, part)
    local behind = styling.smooth(60, 80, math.abs(azimuth))
    return 1 - part * behind * (1 - styling.smooth(-45, 10, elevation))
end

--- Hair of a few millimetres, and its style: shaved sides, or all of a short cut. `options` has its `length`
-- and `density` as style:grow takes them, the `part` of all strands that it holds, and the `seed`.
function styling.stubble(head, o, options)
    local style = lissom.hairstyle(head, { scalp = o.scalp, gravity = 0, resolution = o.resolution })
    styling.streams(style, styling.crown_to_hairline)
    local hair = style:grow{ count = math.floor((options.part or 1) * o.count), seed = options.seed + 101,
        length = options.length, density = options.density, layer = 0.001, clearance = 0.0012, lift = 1,
        variation = 0.15, segment = 0.1, min_speed = 0.01 }
    return style, styling.set_width(hair:resample{ count = 5 }, 0.00024, o.count)
end

--- A mask of the strands that hang over the face.
function styling.over_face(scalp, hair)
    local mask, points, unit, at = {}, hair:points(), scalp:unit(), 0
    for s, count in ipairs(hair:point_counts()) do
        mask[s] = 0
        for i = at + 1, at + count do
            local x, y, z = points:get(i)
            local p = scalp:to_metres(x / unit, y / unit, z / unit)
            local inside = p[3] > 0.02 and p[2] < 0.03 and p[2] > -0.12
            if inside and math.abs(math.deg(atan2(p[1], p[3]))) < 46 then mask[s] = 1 end
        end
        at = at + count
    end
    return mask
end

--- A width in metres that holds for 20,000 to 30,000 strands of a preset, for `count` of them: fewer are
-- up to three times as wide, more down to a third, so that they cover as much of the head.
function styling.width_for(width, count)
    count = math.max(count, 1)
    local few, many = math.min(20000 / count, 3), math.max(30000 / count, 1 / 3)
    return width * math.max(few, math.min(many, 1))
end

--- Gives strands that width; `all` is the number of strands of the preset, else of `hair`.
function styling.set_width(hair, width, all)
    return hair:set_widths{ width = styling.width_for(width, all or #hair) }
end

--- Thin tips, the waves of single hairs, and some that fly away; `width` in metres, and `all` as in
-- styling.set_width.
function styling.finish(hair, width, noise, all)
    hair:noise{ amplitude = noise or 0.001, across = 0.02, along = 0.11 }
    hair:noise{ amplitude = 0.0003, across = 0.0005, along = 0.03, seed = 2 }
    hair:frizz{ amplitude = 0.0003, wavelength = 0.06, flyaways = 0.012, flyaway = 9, seed = 3 }
    return styling.thin_out(styling.set_width(hair, width, all))
end

--- Thins hair out over its last 45 millimetres, or two thirds: tips as thick as the rest make a hem of steps.
function styling.thin_out(hair)
    local length = #hair > 0 and hair:stats().mean_length or 0
    return hair:taper{ tip = 0.12, start = math.max(0.35, 1 - 0.045 / math.max(length, 0.001)) }
end

--- Parts the end of a tail in locks that lean and end one by one: else it closes as smoothly as a drop.
-- `group` names its strands among others, which end before its tie.
function styling.tail_ends(hair, seed, group)
    hair:noise{ amplitude = 0.006, across = 0.008, along = 0.1, shape = 2.5, seed = seed, mask = group }
    hair:clump{ clumps = 160, strength = 0.6, shape = 4, tip_spread = 0.003, offset = 0.012, seed = seed,
        mask = group }
    return hair:clump{ clumps = 1500, strength = 0.4, shape = 1.5, seed = seed + 1 }
end

-- Edges of hair, the options of hair:soften_edge: of hair that is tied or combed back, whose edge is seen,
-- with baby hair; of loose hair; and of short hair, which fades out.
local edges = {
    tied = { width = 0.35, length = 0.9, baby = 0.4, stray = 0.005, reach = 0.03 },
    loose = { width = 0.45, length = 0.9, baby = 0.2, reach = 0.026 },
    short = { width = 0.3, length = 0.2, baby = 0.1, baby_length = 0.006, stray = 0.001, reach = 0.042 },
}

--- Width in metres of the band over which hair thins out at the hairline of a preset.
styling.softness = 0.03

-- The edge of a preset's hair: a little lower than an average one, as it thins out over a wide band; close
-- around the ears.
local hairline = { { 0, 34 }, { 20, 35 }, { 38, 34 }, { 52, 26 }, { 62, 11 }, { 70, -4 }, { 76, -14 },
    { 82, -17 }, { 86, -13 }, { 90, -5 }, { 95, -2 }, { 101, -3 }, { 106, -10 }, { 110, -20 }, { 114, -30 },
    { 121, -40 }, { 135, -47 }, { 155, -51 }, { 180, -54 } }

--- Elevation of the hairline of presets at an azimuth, in degrees.
function styling.hairline_at(azimuth)
    local a = math.abs((azimuth + 180) % 360 - 180)
    for i = 2, #hairline do
        local from, to = hairline[i - 1], hairline[i]
        if a <= to[1] then return from[2] + (to[2] - from[2]) * (a - from[1]) / (to[1] - from[1]) end
    end
    return hairline[#hairline][2]
end

--- The scalp of a head for a preset: its hair thins out at a hairline that wanders as a grown one does. The
-- `unit` in metres may be absent.
function styling.scalp(head, unit)
    return lissom.scalp(head, { unit = unit, softness = styling.softness, hairline = hairline,
        recession = 0.004, irregular = 0.003 })
end

-- Locks differ in tone, or hair looks like a helmet. Hair that lies in no order reflects light in no narrow
-- band.
local natural = { strand_tone = 0.2, clump_tone = 0.18, clump_size = 0.007, shift_jitter = 0.08 }
local sheen = {
    short = { primary = 0.09, primary_exponent = 12, secondary = 0.36, secondary_exponent = 8,
        clump_tone = 0.06 },
}

--- How hair of an edge looks, the option `hair` of lissom.render; `own` counts before it.
function styling.look(edge, own)
    local all = {}
    for _, from in ipairs{ natural, sheen[edge] or {}, own or {} } do
        for key, value in pairs(from) do all[key] = value end
    end
    return all
end

--- Softens the edge of the hair of a style: "tied", "loose" or "short".
function styling.soften(style, hair, edge, seed)
    local options = { head = style, seed = seed }
    for key, value in pairs(edges[edge]) do options[key] = value end
    return hair:soften_edge(options)
end

-- Values of all parameters: those given, else the defaults. An unknown name is an error.
local function complete(preset, values)
    local all = {}
    for name, one in pairs(preset.schema) do all[name] = one.default end
    for name, value in pairs(values or {}) do
        if all[name] == nil then
            lissom.error{ message = "the " .. preset.name .. " has no parameter '" .. name .. "'", level = 4 }
        end
        all[name] = value
    end
    return all
end

--- Makes a preset of its `name`, the `schema` of its parameters as lissom.params takes them, and `make(head,
-- values, options)`, which returns the style, its hair, how it looks (the option `hair` of lissom.render) and
-- meshes to draw with it. `options` holds the scalp and the resolution for lissom.hairstyle and the
-- `count` of strands. `preset.grow(head, values, options)` calls it. With `module`, the name that the file
-- was required by, it is returned; run as a script, it makes hair and pictures. The preset's `edge` is that
-- of styling.soften; without one the edge stays as it is.
function styling.preset(module, preset)
    preset.schema.seed = { type = "integer", default = 1, min = 1, help = "chance" }
    function preset.grow(head, values, options)
        local all = { count = 30000, resolution = 50000 }
        for key, value in pairs(options or {}) do all[key] = value end
        all.scalp = all.scalp or styling.scalp(head)
        local full = complete(preset, values)
        local style, hair, look, meshes = preset.make(head, full, all)
        if preset.edge then styling.soften(style, hair, preset.edge, full.seed) end
        return style, hair, styling.look(preset.edge, look), meshes
    end
    if module == "presets." .. preset.name then return preset end
    local params = hairdo.params{ name = preset.name, count = 30000, more = preset.schema }
    local values = {}
    for name in pairs(preset.schema) do values[name] = params[name] end
    local head = hairdo.head(params)
    local style, hair, look, meshes = preset.grow(head, values,
        { scalp = styling.scalp(head, params.unit > 0 and params.unit or nil), resolution = params.resolution,
            count = params.count })
    local files = {}
    for _, key in ipairs{ "out", "name", "format", "pictures", "size" } do files[key] = params[key] end
    hairdo.finish(style, hair, files, meshes, look)
    return preset
end

return styling
