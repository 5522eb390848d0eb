--- Common parts of scripts of hairstyles: their parameters, heads, the finish of hair, and pictures of it.
local lissom = require "lissom"

local hairdo = {}

-- Colour of heads in pictures of hair.
hairdo.skin = "#cfae9a"

-- With two arguments in every Lua.
local atan2 = rawget(math, "atan2") or math.atan

-- Parameters of a hairstyle: the `name` of its files, the `count` of its strands, `more` of its own.
function hairdo.params(options)
    local list = {
        head = { type = "file", default = "", help = "a bald head, instead of the generated one" },
        unit = { type = "number", default = 0, min = 0, unit = "metres",
            help = "length of a unit of the head; 0 as its size tells" },
        vertices = { type = "integer", default = 40000, min = 3000, max = 500000,
            help = "of the generated head" },
        count = { type = "integer", default = options.count or 100000, min = 0, max = 2000000,
            help = "strands" },
        resolution = { type = "integer", default = 50000, min = 1000, max = 2000000, help = "grid points" },
        detail = { type = "boolean", default = true, help = "clumps, noise and tapered tips" },
        pictures = { type = "boolean", default = true, help = "writes pictures" },
        size = { type = "integer", default = 800, min = 64, max = 4096, unit = "pixels",
            help = "width and height of each picture" },
        out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
        format = { type = "choice", default = "usda",
            choices = { "usda", "hair", "tfx", "ply", "glb", "data", "rib", "obj" },
            help = "of the hair's file; usda and ply hold groups and roots too" },
        name = { type = "string", default = options.name, help = "name of the files" },
    }
    for key, value in pairs(options.more or {}) do list[key] = value end
    return lissom.params(list)
end

-- A parameter for figures of the thesis, among the `more` of hairdo.params: how closely they keep to it.
hairdo.fidelity = { type = "choice", default = "default", choices = { "default", "thesis" },
    help = "thesis: chapter 4 to the letter; files are called NAME_thesis" }

function hairdo.head(params)
    if params.head == "" then return lissom.shapes.head{ vertices = params.vertices } end
    return lissom.load(params.head)
end

-- The scalp of a head in the unit of the parameters; its hair thins out over `softness` metres, or the usual.
function hairdo.scalp(head, params, softness)
    return lissom.scalp(head, { unit = params.unit > 0 and params.unit or nil, softness = softness })
end

-- A style with the unit and resolution of the parameters; `options` are further ones of lissom.hairstyle.
-- Its curves determine all hair, without gravity.
function hairdo.style(head, params, options)
    local all = { scalp = hairdo.scalp(head, params), resolution = params.resolution, gravity = 0 }
    for key, value in pairs(options or {}) do all[key] = value end
    return lissom.hairstyle(head, all)
end

-- Hair of a figure, with the options of style:grow. To the letter of the thesis it is as long as the field
-- carries it, and kept out of the head by the scalp step alone, once the curves are there.
function hairdo.grow(style, params, options)
    options.count = params.count
    if style:stats().fidelity == "default" then return style:grow(options) end
    return style:avoid_scalp():grow{ count = params.count }
end

-- The volume of a style, {min=, max=} in metres, that holds the scalp and the spines of tails, with so much
-- `room` around those. The smaller the volume is, the finer is the grid of the field.
function hairdo.volume(scalp, room, ...)
    local positions = scalp:head():positions()
    local low, high = { 1e9, 1e9, 1e9 }, { -1e9, -1e9, -1e9 }
    local function extend(point, around)
        local p = scalp:to_metres(point)
        for k = 1, 3 do
            low[k] = math.min(low[k], p[k] - around)
            high[k] = math.max(high[k], p[k] + around)
        end
    end
    for _, v in ipairs(scalp:region():vertices()) do
        extend({ positions[3 * v - 2], positions[3 * v - 1], positions[3 * v] }, 0.03)
    end
    for _, points in ipairs{ ... } do
        for _, point in ipairs(points) do extend(point, room) end
    end
    return { min = low, max = high }
end

-- Points of a spine nearer to the head than `distance` are moved away from it.
local function pushed_out(scalp, p, distance)
    local q = scalp:to_metres(scalp:head():nearest(scalp:from_metres(p)).position)
    local away = { p[1] - q[1], p[2] - q[2], p[3] - q[3] }
    local d = math.sqrt(away[1] ^ 2 + away[2] ^ 2 + away[3] ^ 2)
    if d >= distance or d == 0 then return p end
    for k = 1, 3 do away[k] = q[k] + away[k] * distance / d end
    return away
end

-- The spine of a tail: from a tie over the head it goes out and bends down as it goes on. `tail` has the
-- direction of the tie (`azimuth`, `elevation`), how far it is above the head (`lift`), the `length` of the
-- tail, its `radius`, and the length over which it bends (`droop`); lengths are in metres.
function hairdo.tail_spine(scalp, tail)
    local tie = { azimuth = tail.azimuth, elevation = tail.elevation, lift = tail.lift }
    local at, normal = scalp:at(tie), scalp:normal_at(tie)
    local from, to = scalp:to_metres(at), {}
    for k = 1, 3 do to[k] = at[k] + normal[k] * scalp:scale() end
    to = scalp:to_metres(to)
    local d = { to[1] - from[1], to[2] - from[2] + 0.15, to[3] - from[3] }
    local points, step = { at }, 0.004
    local p, bend = from, step / math.max(tail.droop, 0.001)
    for i = 1, math.floor(tail.length / step) do
        local length = math.sqrt(d[1] ^ 2 + d[2] ^ 2 + d[3] ^ 2)
        for k = 1, 3 do d[k] = d[k] / length end
        p = { p[1] + step * d[1], p[2] + step * d[2], p[3] + step * d[3] }
        if i % 4 == 0 then
            points[#points + 1] = scalp:from_metres(pushed_out(scalp, p, tail.radius or 0.016))
        end
        d = { d[1] - bend * d[1], d[2] - bend * (1 + d[2]), d[3] - bend * d[3] }
    end
    return points
end

-- A unit vector in metres of a scalp's frame, and back.
local function direction_of(azimuth, elevation)
    local a, e = math.rad(azimuth), math.rad(elevation)
    return { math.cos(e) * math.sin(a), math.sin(e), math.cos(e) * math.cos(a) }
end

local function angles_of(d)
    return math.deg(atan2(d[1], d[3])), math.deg(math.asin(math.max(-1, math.min(1, d[2]))))
end

local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end

-- Returns the place of a tie: its center in metres, the direction to it, and its distance from the center of
-- the head.
local function tie_of(scalp, tail)
    local center = scalp:to_metres(scalp:at{ azimuth = tail.azimuth, elevation = tail.elevation,
        lift = tail.lift })
    return { center = center, out = direction_of(tail.azimuth, tail.elevation),
        radius = math.sqrt(dot(center, center)) }
end

-- Whether the ring of a tail's tie is at least `distance` from the head, in metres.
local function ring_is_free(scalp, tail, distance)
    local tie, a = tie_of(scalp, tail), math.rad(tail.azimuth)
    local side = { math.cos(a), 0, -math.sin(a) }
    local up = { tie.out[2] * side[3] - tie.out[3] * side[2], tie.out[3] * side[1] - tie.out[1] * side[3],
        tie.out[1] * side[2] - tie.out[2] * side[1] }
    for turn = 0, 330, 30 do
        local p, c, s = {}, math.cos(math.rad(turn)), math.sin(math.rad(turn))
        for k = 1, 3 do p[k] = tie.center[k] + tail.radius * (c * side[k] + s * up[k]) end
        local q = scalp:to_metres(scalp:head():nearest(scalp:from_metres(p)).position)
        local off = { p[1] - q[1], p[2] - q[2], p[3] - q[3] }
        if dot(off, off) < distance ^ 2 then return false end
    end
    return true
end

-- Moves a tie that would lie on an ear back along its height, by at most 30 degrees, until its ring is free:
-- no hair gets into a ring that an ear fills.
function hairdo.keep_off_ears(scalp, tail)
    local azimuth = (tail.azimuth + 180) % 360 - 180
    local sign = azimuth < 0 and -1 or 1
    for back = 0, 30, 2 do
        if math.abs(azimuth) + back > 180 then return end
        local moved = { azimuth = azimuth + sign * back, elevation = tail.elevation, lift = tail.lift,
            radius = tail.radius }
        if ring_is_free(scalp, moved, 0.4 * tail.lift) then
            tail.azimuth = moved.azimuth
            return
        end
    end
end

-- A stream through directions over the head, {azimuth, elevation, lift}, and on into the rim of a tie, from
-- its own side.
local function lead_into(style, tail, tie, places, name)
    local scalp, points = style:scalp(), {}
    for i, place in ipairs(places) do
        points[i] = style:at{ azimuth = place[1], elevation = place[2], lift = place[3] }
    end
    local last, inward = scalp:to_metres(points[#points]), {}
    local along = 0
    for k = 1, 3 do along = along + (last[k] - tie.center[k]) * tie.out[k] end
    for k = 1, 3 do inward[k] = last[k] - tie.center[k] - along * tie.out[k] end
    local length = math.sqrt(dot(inward, inward))
    for k = 1, 3 do inward[k] = tie.center[k] + 0.5 * tail.radius * inward[k] / length end
    points[#points + 1] = scalp:from_metres(inward)
    style:add_stream{ points = points, stop = false, name = name }
end

-- Streams from all around a tie into it, close over the head: `count` of them. `low` is their height over the
-- head, `reach` how far from the tie they begin; in metres. A function `skip(azimuth, elevation)` leaves out
-- streams that begin at directions for which it is true.
function hairdo.gather(style, tail, options)
    local tie, a = tie_of(style:scalp(), tail), math.rad(tail.azimuth)
    local out, side = tie.out, { math.cos(a), 0, -math.sin(a) }
    local up = { out[2] * side[3] - out[3] * side[2], out[3] * side[1] - out[1] * side[3],
        out[1] * side[2] - out[2] * side[1] }
    for i = 1, options.count do
        local turn, places = 2 * math.pi * (i - 1) / options.count, {}
        for _, f in ipairs{ 1, 0.75, 0.5, 0.3 } do
            local angle = f * options.reach / tie.radius
            local d = {}
            for k = 1, 3 do
                d[k] = math.cos(angle) * out[k]
                    + math.sin(angle) * (math.cos(turn) * side[k] + math.sin(turn) * up[k])
            end
            local azimuth, elevation = angles_of(d)
            places[#places + 1] = { azimuth, elevation, options.low + (1 - f) ^ 2 * tail.lift * 0.8 }
        end
        if not (options.skip and options.skip(places[1][1], places[1][2])) then
            lead_into(style, tail, tie, places, "gather " .. i)
        end
    end
end

-- Streams into a tie from farther away: each of `routes` is a list of directions over the head, {azimuth,
-- elevation}, from which hair goes on to the tie on the shortest way. `low` as in hairdo.gather.
function hairdo.lead(style, tail, options)
    local tie = tie_of(style:scalp(), tail)
    local near = math.rad(12)
    for i, route in ipairs(options.routes) do
        local places = {}
        local function add(d)
            local angle = math.acos(math.max(-1, math.min(1, dot(d, tie.out))))
            local azimuth, elevation = angles_of(d)
            local rise = math.max(0, 1 - angle * tie.radius / 0.08) ^ 2 * tail.lift * 0.8
            if angle > near then places[#places + 1] = { azimuth, elevation, options.low + rise } end
            return angle
        end
        local d, angle
        for _, place in ipairs(route) do
            d = direction_of(place[1], place[2])
            angle = add(d)
        end
        local steps = math.floor(angle / math.rad(20))
        for k = 1, steps do
            local f, on = k / (steps + 1), {}
            for j = 1, 3 do
                on[j] = math.sin((1 - f) * angle) * d[j] + math.sin(f * angle) * tie.out[j]
                on[j] = on[j] / math.sin(angle)
            end
            add(on)
        end
        if #places > 1 then lead_into(style, tail, tie, places, "lead " .. i) end
    end
end

-- Takes away hair that missed its tie and hangs free: strands of no group with a tip more than three
-- centimetres off the head.
function hairdo.cull_missed(hair, scalp)
    local unit, missed, any = scalp:unit(), {}, false
    for s = 1, #hair do
        missed[s] = 0
        if not hair:root(s).group then
            local strand = hair:strand(s)
            local x, y, z = strand:get(strand:count())
            local tip = { x / unit, y / unit, z / unit }
            local foot, off = scalp:head():nearest(tip).position, 0
            for k = 1, 3 do off = off + (tip[k] - foot[k]) ^ 2 end
            if math.sqrt(off) > 0.03 * scalp:scale() then missed[s], any = 1, true end
        end
    end
    return any and hair:cull{ mask = missed } or hair
end

-- The ring of a tie, for pictures: a mesh around the first cross section of a tail.
function hairdo.ring(scalp, tail)
    local tie = { azimuth = tail.azimuth, elevation = tail.elevation, lift = tail.lift }
    return hairdo.ring_around(scalp, scalp:at(tie), scalp:normal_at(tie), 0.75 * tail.radius, 0.0042)
end

-- The same around a point of the head's space in a direction of unit length, by its radius and that of its
-- tube in metres.
function hairdo.ring_around(scalp, center, direction, radius, tube)
    local size = scalp:scale()
    local ring = lissom.shapes.torus{ radius = radius * size, tube_radius = tube * size }
    -- From +y to the direction.
    local axis = { direction[3], 0, -direction[1] }
    local angle = math.deg(math.acos(math.max(-1, math.min(1, direction[2]))))
    if axis[1] == 0 and axis[3] == 0 then axis[1] = 1 end
    if angle > 1e-6 then ring:transform{ rotate = { axis = axis, angle = angle, about = { 0, 0, 0 } } } end
    return ring:transform{ translate = center }
end

-- A camera at a side of the head ("front", "left", "back", "right", "three-quarter") that shows the
-- head from the chin up, and all of the hair.
function hairdo.camera(style, hair, side)
    local scalp = style:scalp()
    local low, high = scalp:from_metres(-0.11, -0.15, -0.1), scalp:from_metres(0.11, 0.13, 0.12)
    local box, unit = hair:bounds(), scalp:unit()
    local target, radius = {}, 0
    for k = 1, 3 do
        local a = math.min(low[k], high[k], box.min[k] / unit)
        local b = math.max(low[k], high[k], box.max[k] / unit)
        target[k] = (a + b) / 2
        radius = radius + ((b - a) / 2) ^ 2
    end
    radius = math.sqrt(radius)
    local turn = ({ front = 0, left = 90, back = 180, right = -90 })[side] or 35
    local rise = side == "three-quarter" and 12 or 4
    local fov = 24
    local distance = 0.84 * radius / math.sin(math.rad(fov / 2))
    local front, left, up = scalp:front(), scalp:left(), scalp:up()
    local eye = {}
    for k = 1, 3 do
        local level = math.cos(math.rad(turn)) * front[k] + math.sin(math.rad(turn)) * left[k]
        eye[k] = target[k] + distance * (math.cos(math.rad(rise)) * level + math.sin(math.rad(rise)) * up[k])
    end
    return lissom.camera{ eye = eye, target = target, up = up, fov = fov }
end

-- Local detail, files and pictures of grown hair. `rings` are meshes to draw with the head, `look` the option
-- `hair` of lissom.render.
function hairdo.finish(style, hair, params, rings, look)
    if params.detail then hairdo.detail(hair) end
    local literal = style:stats().fidelity == "thesis"
    local path = params.out .. "/" .. params.name .. (literal and "_thesis" or "")
    style:save(path .. ".json")
    hair:save(path .. "." .. params.format)
    if not params.pictures then return end
    local meshes, colors = { style:head() }, { hairdo.skin }
    for _, ring in ipairs(rings or {}) do
        meshes[#meshes + 1], colors[#colors + 1] = ring, "#2a1c28"
    end
    for _, side in ipairs{ "front", "left", "back", "three-quarter" } do
        lissom.render{
            meshes = meshes, color = colors, strands = hair, camera = hairdo.camera(style, hair, side),
            size = { params.size, params.size }, supersample = 2, background = "#c8ccd2", hair = look,
            file = path .. "_" .. side .. ".png",
        }
    end
end

-- Locks, waves and single hairs; thin tips.
function hairdo.detail(hair)
    hair:smooth{ iterations = 3 }
    hair:clump{ clumps = 2500, strength = 0.3 }
    hair:noise{ amplitude = 0.0016, across = 0.02, along = 0.11 }
    hair:noise{ amplitude = 0.0003, across = 0.0005, along = 0.03, seed = 2 }
    return hair:taper{ tip = 0.12, start = 0.35 }
end

return hairdo
