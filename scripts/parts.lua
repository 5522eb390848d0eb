--- Generated features to paste: a nose, an ear, a horn, a handle, a spike, a scale, a leaf.
--
--     local parts = require "parts"
--     local horn = parts.make("horn")
--     local paste = lissom.paste{ source = horn.mesh, region = horn.region, feature = horn.feature,
--         target = head, placement = { at = { 0, 1, 0 }, scale = 0.2, up = horn.up } }
--
-- Each stands on a round plate of radius 1 in the plane of x and y, and looks along z; y is up on it. It is a
-- table as lissom.part.load returns.
local lissom = require "lissom"

local parts = {}

local function smoothstep(a, b, x)
    local t = math.max(0, math.min(1, (x - a) / (b - a)))
    return t * t * (3 - 2 * t)
end

-- A plate with a bump: profile(t) gives radius and height for t from 0, the rim of the bump, to 1, its tip;
-- shape(x, y, z, t) bends the result. The plate has radius 1, the bump's foot the radius `foot`.
local function raised(options)
    local segments, foot = options.segments or 36, options.foot
    local positions, faces, rings = {}, {}, {}
    local function ring(radius, height, t)
        for k = 0, segments - 1 do
            local angle = 2 * math.pi * (k + 0.5 * (#rings % 2)) / segments
            local x, y = radius * math.cos(angle), radius * math.sin(angle)
            table.insert(positions, { options.shape(x, y, height, t) })
        end
        table.insert(rings, #positions - segments)
    end
    local plate = math.max(4, math.floor(segments * (1 - foot) / 5 + 0.5))
    for i = 0, plate - 1 do ring(1 - (1 - foot) * i / plate, 0, 0) end
    local steps = options.steps or 24
    for i = 0, steps - 1 do
        local radius, height = options.profile(i / steps)
        ring(radius, height, i / steps)
    end
    local _, top = options.profile(1)
    table.insert(positions, { options.shape(0, 0, top, 1) })
    for i = 1, #rings - 1 do
        local a, b, odd = rings[i], rings[i + 1], (i - 1) % 2
        for k = 0, segments - 1 do
            local next = (k + 1) % segments
            local a0, a1, b0, b1 = a + k + 1, a + next + 1, b + k + 1, b + next + 1
            if odd == 0 then
                table.insert(faces, { a0, a1, b0 })
                table.insert(faces, { b0, a1, b1 })
            else
                table.insert(faces, { a0, b1, b0 })
                table.insert(faces, { a0, a1, b1 })
            end
        end
    end
    for k = 0, segments - 1 do
        table.insert(faces, { rings[#rings] + k + 1, rings[#rings] + (k + 1) % segments + 1, #positions })
    end
    return lissom.mesh{ positions = positions, faces = faces }
end

-- A cone of this height with a flared foot and a round tip.
local function cone(foot, height, sharp)
    return function(t)
        local along = t ^ 0.9
        local flare = foot * (1 - along) ^ (sharp or 1)
        return flare * (1 - 0.25 * math.sin(math.pi * along) ^ 2), height * smoothstep(-0.25, 1.02, along)
            - height * smoothstep(-0.25, 1.02, 0)
    end
end

-- Half an ellipse.
local function dome(foot, height)
    return function(t)
        local angle = t * math.pi / 2
        return foot * math.cos(angle), height * math.sin(angle) * smoothstep(-0.4, 0.5, t)
            / smoothstep(-0.4, 0.5, 1)
    end
end

local makers = {}

function makers.horn(o)
    local bend, height = o.bend or 0.8, o.height or 2.2
    return raised{ foot = 0.5, steps = 40, profile = cone(0.5, height, 0.8),
        shape = function(x, y, z) return x, y + bend * (z / height) ^ 2, z end }
end

function makers.spike(o)
    local height = o.height or 1.3
    return raised{ foot = 0.55, steps = 14, segments = o.segments or 20, profile = cone(0.55, height, 0.9),
        shape = function(x, y, z) return x, y, z end }
end

function makers.nose(o)
    local height = o.height or 0.62
    return raised{ foot = 0.62, steps = 24, profile = dome(0.62, height),
        shape = function(x, y, z, t)
            -- Narrow above, wide at the nostrils, highest at the tip, which is low.
            local up = y / 0.62
            local width = 0.62 - 0.22 * up - 0.10 * smoothstep(0, 1, t)
            local tip = 1 - 0.55 * smoothstep(-0.5, 1, up)
            local s = smoothstep(0, 0.2, z / height)
            return x * (1 + s * (width - 1)), y * (1 + 0.15 * s) - 0.12 * z, z * tip
        end }
end

function makers.ear(o)
    local height = o.height or 1.5
    return raised{ foot = 0.5, steps = 36, segments = 40, profile = dome(0.5, height),
        shape = function(x, y, z)
            -- A flap: thin in x, tall in y; hollow in front, which is on the side of x.
            local s = smoothstep(0, 0.5, z / height)
            local wide = 1 + s * (0.75 * math.sin(math.pi * math.min(1, z / height)))
            local flat, tall = x * (1 - 0.55 * s), y * wide + 0.35 * z
            local from_middle = (y / 0.34) ^ 2 + ((z - 0.55 * height) / 0.42) ^ 2
            local hollow = 0.34 * s * math.exp(-from_middle)
            return flat - hollow * (x > 0 and 1 or 0.65) + 0.12 * z, tall, z
        end }
end

function makers.scale(o)
    local height = o.height or 0.34
    return raised{ foot = 0.72, steps = 9, segments = o.segments or 22, profile = dome(0.72, height),
        shape = function(x, y, z)
            local s = smoothstep(0, 0.9, z / height)
            return x * (1 - 0.10 * s), y - 0.34 * s - 0.08 * s * y, z * (0.75 - 0.45 * y)
        end }
end

function makers.leaf(o)
    local height = o.height or 1.9
    return raised{ foot = 0.42, steps = 20, segments = o.segments or 20,
        profile = function(t)
            local wide = 0.42 * (1 - t) + 0.34 * math.sin(math.pi * t) ^ 1.2
            return wide, height * smoothstep(-0.35, 1.1, t) - height * smoothstep(-0.35, 1.1, 0)
        end,
        shape = function(x, y, z)
            local s = smoothstep(0, 0.3, z / height)
            return x * (1 + 0.25 * s), y * (1 - 0.78 * s) - 0.55 * (z / height) ^ 2 * height * 0.5, z
        end }
end

-- A plate of cells with an arch: the only part with a hole.
function makers.handle(o)
    local blocks = require "blocks"
    local mesh = blocks.surface{ levels = o.levels or 3, soft = 4, cells = blocks.cells{
        { 0, 0, 0, 10, 0, 6 }, { 2, 1, 3, 2, 3, 3 }, { 8, 1, 3, 8, 3, 3 }, { 2, 3, 3, 8, 3, 3 } } }
    mesh:transform{ translate = { -5.5, -1, -3.5 } }
    mesh:transform{ rotate = { axis = "x", angle = 90 } }
    return mesh:transform{ scale = 1 / 4.6 }
end

-- How far from the middle the region and the feature reach in the plane of x and y.
local reaches = { horn = { 0.93, 0.56 }, spike = { 0.93, 0.6 }, nose = { 0.93, 0.66 }, ear = { 0.93, 0.56 },
    scale = { 0.95, 0.76 }, leaf = { 0.93, 0.5 } }

--- The names of the parts, sorted.
parts.names = { "ear", "handle", "horn", "leaf", "nose", "scale", "spike" }

--- A part by its name. Options: height, for all but the handle; bend, of a horn; segments around a spike,
-- scale or leaf; levels of subdivision of a handle.
function parts.make(name, options)
    local maker = makers[name]
    if not maker then
        lissom.error{ level = 2,
            message = "there is no part '" .. tostring(name) .. "'; there are "
                .. table.concat(parts.names, ", ") }
    end
    local mesh, reach = maker(options or {}), reaches[name]
    local region, feature
    if reach then
        local function plane_reach(limit)
            return function(_, x, y, z) return z > 1e-3 or x * x + y * y < limit * limit end
        end
        region = mesh:region{ where = plane_reach(reach[1]) }
        feature = mesh:region{ where = plane_reach(reach[2]) }
    else
        region = mesh:region{ where = function(_, x, y, z)
            return z > 0.02 or z > -0.12 and (x / 1.04) ^ 2 + (y / 0.62) ^ 2 < 1
        end }
        feature = mesh:region{ where = function(_, x, y, z)
            return z > 0.1 or z > -0.12 and (x / 0.86) ^ 2 + (y / 0.34) ^ 2 < 1
        end }
    end
    return { mesh = mesh, region = region, feature = feature, up = { 0, 1, 0 }, front = { 0, 0, 1 } }
end

return parts
