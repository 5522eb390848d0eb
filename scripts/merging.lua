--- Merging by planes and directions instead of ids, and its pictures.
--
--     local merging = require "merging"
--     local mesh, report, parts = merging.join(fish, torso, {
--         source_cut = { point = { 0, 0.1, -0.2 }, normal = { 0, 0, -1 } },
--         target_cut = { point = { 0, -1, 0 }, normal = { 0, 1, 0 } },
--         keys = { { "y", "-z" }, { "-y", "z" } },
--     })
--     require("merge_pictures").write{ name = "mermaid", mesh = mesh, report = report, parts = parts }
--
-- A cut is { point=, normal=, seed= }: the line of the plane that is nearest to the point is cut, and the
-- side of the normal, or of the seed, is kept. Without a cut the longest open boundary is taken.
-- A key is a pair of directions: the vertex of the source's boundary that is farthest along the first meets
-- the vertex of the target's that is farthest along the second. A direction is {x, y, z}, "x", "-z" or "0,
-- 1, -0.5". On a boundary that is tilted towards a direction, so that this comes near to the boundary's axis,
-- the farthest vertex follows the tilt and not the direction: a warning says so, and a
-- direction in the boundary's plane, a vertex in `joins` of lissom.merge, or source_front and target_front
-- (whose part in that plane counts) are surer.
local lissom = require "lissom"
local vectors = require "vectors"

-- A direction whose part in the plane of a boundary is less than this is ambiguous as a key: it comes within
-- 30 degrees of the boundary's axis.
local min_part = 0.5

local cross, dot, length, plus, unit = vectors.cross, vectors.dot, vectors.length, vectors.plus, vectors.unit

local merging = {}

-- ---- Directions, cuts and keys as scripts and command lines give them

local function numbers(text)
    local list = {}
    for word in text:gmatch("[^,%s]+") do
        local number = tonumber(word)
        if not number then return nil end
        table.insert(list, number)
    end
    return #list == 3 and list or nil
end

local axes = { x = { 1, 0, 0 }, y = { 0, 1, 0 }, z = { 0, 0, 1 } }

--- The vector that a direction means: {x, y, z}, or "x", "-y", "0, 1, -0.5".
function merging.direction(value)
    if type(value) == "table" and #value == 3 and length(value) > 0 then return value end
    if type(value) == "string" then
        local sign, axis = value:match("^%s*([+-]?)([xyz])%s*$")
        if axis then return plus({ 0, 0, 0 }, axes[axis], sign == "-" and -1 or 1) end
        local vector = numbers(value)
        if vector and length(vector) > 0 then return vector end
    end
    lissom.error{ level = 2,
        message = "a direction is {x, y, z}, \"x\", \"-y\" or \"0, 1, -0.5\", not " .. tostring(value) }
end

--- The cut that "point; normal" or "point; normal; seed" means, as "0, -0.95, 0; 0, 1, 0"; nil for "" and
-- nil. A table is returned as it is.
function merging.read_cut(text)
    if text == nil or text == "" then return nil end
    if type(text) == "table" then return text end
    local list = {}
    for part in (text .. ";"):gmatch("([^;]*);") do table.insert(list, numbers(part) or false) end
    local point, normal, seed = list[1], list[2], list[3]
    if not point or not normal or seed == false or #list > 3 then
        lissom.error{ level = 2, message = "a cut is \"x, y, z; x, y, z\", a point and a normal, perhaps "
            .. "\"; x, y, z\" of a seed, not '" .. text .. "'" }
    end
    return { point = point, normal = normal, seed = seed }
end

--- The keys that "y = -z; -y = z" means: pairs of directions on the source and on the target; nil for "" and
-- nil. A table is returned as it is.
function merging.read_keys(text)
    if text == nil or text == "" then return nil end
    if type(text) == "table" then return text end
    local keys = {}
    for pair in text:gmatch("[^;]+") do
        local from, to = pair:match("^([^=]+)=([^=]+)$")
        if not from then
            lissom.error{ level = 2,
                message = "keys are \"direction = direction; ...\", the source's first, not '" .. text
                    .. "'" }
        end
        table.insert(keys, { merging.direction(from), merging.direction(to) })
    end
    return keys
end

-- ---- Boundaries

--- A direction turned about an axis by an angle in degrees.
function merging.turned(direction, axis, angle)
    local d, n = merging.direction(direction), unit(merging.direction(axis))
    local c, s = math.cos(math.rad(angle)), math.sin(math.rad(angle))
    return plus(plus(plus({ 0, 0, 0 }, d, c), cross(n, d), s), n, (1 - c) * dot(n, d))
end

--- The vertex of a boundary that is farthest along a direction; of several that are, the one in their middle.
function merging.extreme(boundary, direction)
    local d, points = unit(merging.direction(direction)), boundary:points()
    local most, slack = -math.huge, 1e-6 * boundary:length()
    for _, p in ipairs(points) do most = math.max(most, dot(p, d)) end
    local middle, count = { 0, 0, 0 }, 0
    for _, p in ipairs(points) do
        if dot(p, d) >= most - slack then middle, count = plus(middle, p, 1), count + 1 end
    end
    middle = plus({ 0, 0, 0 }, middle, 1 / count)
    local best, nearest
    for i, p in ipairs(points) do
        local distance = length(plus(p, middle, -1))
        if dot(p, d) >= most - slack and (not best or distance < nearest - slack) then
            best, nearest = i, distance
        end
    end
    return boundary:vertices()[best]
end

--- The mean point of a boundary's vertices.
function merging.center(boundary)
    local sum, points = { 0, 0, 0 }, boundary:points()
    for _, p in ipairs(points) do sum = plus(sum, p, 1 / #points) end
    return sum
end

-- The boundary of a mesh for which measure(boundary) is least.
local function min_boundary(mesh, measure)
    local best, least
    for _, boundary in ipairs(mesh:boundaries()) do
        local value = measure(boundary)
        if not best or value < least then best, least = boundary, value end
    end
    return best
end

--- The unit vector that points out of the opening: that around which a boundary runs clockwise, having the
-- surface on its left.
function merging.axis(boundary)
    local points, center, axis = boundary:points(), merging.center(boundary), { 0, 0, 0 }
    for i, p in ipairs(points) do
        axis = plus(axis, cross(plus(p, center, -1), plus(points[i % #points + 1], center, -1)), -1)
    end
    return unit(axis)
end

--- Returns the angle in degrees between a direction and the plane of a boundary: 0 if the farthest vertex
-- along it is certain, towards 90 if the boundary's tilt decides.
function merging.tilt(boundary, direction)
    local d = unit(merging.direction(direction))
    return math.deg(math.asin(math.min(1, math.abs(dot(d, merging.axis(boundary))))))
end

-- Returns the warning for a key whose direction is ambiguous on a boundary.
local function tilt_warning(number, side, boundary, direction)
    local tilt = merging.tilt(boundary, direction)
    if math.cos(math.rad(tilt)) >= min_part then return nil end
    return string.format("key %d: the %s's boundary is tilted, its axis %.0f degrees from the direction: the "
        .. "farthest vertex may not be the one you mean; give a direction in the boundary's plane",
        number, side, 90 - tilt)
end

--- Key vertices of two boundaries: for each pair of directions the vertices that are farthest along them;
-- and a list of warnings about directions that are ambiguous because a boundary is tilted.
function merging.keys(source, target, directions)
    local keys, warnings = {}, {}
    for i, pair in ipairs(directions) do
        if type(pair) ~= "table" or #pair ~= 2 then
            lissom.error{ level = 2,
                message = "key " .. i .. " is no pair of directions, the source's and the target's" }
        end
        keys[i] = { merging.extreme(source, pair[1]), merging.extreme(target, pair[2]) }
        table.insert(warnings, tilt_warning(i, "source", source, pair[1]))
        table.insert(warnings, tilt_warning(i, "target", target, pair[2]))
    end
    return keys, warnings
end

--- The open boundary of a mesh that comes nearest to a point, or nil.
function merging.boundary_near(mesh, point)
    return min_boundary(mesh, function(boundary) return boundary:nearest(point).distance end)
end

--- The longest open boundary of a mesh, or nil.
function merging.longest_boundary(mesh)
    return min_boundary(mesh, function(boundary) return -boundary:length() end)
end

--- Returns the part of a mesh that a cut keeps, its new boundary, and the warnings of the cut.
-- Without a cut returns the mesh itself and its longest boundary. Raises boundary_conflict if the plane
-- cuts no part off.
function merging.part(mesh, cut)
    if not cut then
        local boundary = merging.longest_boundary(mesh)
        if not boundary then
            lissom.error{ message = "the mesh is closed; give a cut that opens it", level = 2 }
        end
        return mesh, boundary, {}
    end
    local plane = {}
    for key, value in pairs(cut) do plane[key] = value end
    plane.normal = merging.direction(cut.normal)
    local kept, _, lines = mesh:cut{ plane = plane }
    return kept, lines[1], lines.report.warnings
end

-- The results of `lissom.try`; raises its error under a name.
local function handed_on(name, first, problem, ...)
    if first == nil and type(problem) == "table" and problem.code then
        problem.message = name .. ": " .. problem.message
        error(problem, 0)
    end
    return first, problem, ...
end

--- Calls a function; the message of its error begins with `name`, the part that it works on.
function merging.named(name, f, ...)
    return handed_on(name, lissom.try(f, ...))
end

-- ---- Joining

local direction_options = { "source_up", "source_front", "target_up", "target_front" }
local merge_options = { "configuration", "place", "fixed", "reach", "frames", "seam", "smooth", "collar",
    "transition", "trim", "max_turn", "subdivide", "intersections", "mend", "fidelity", "source_up",
    "source_front", "target_up", "target_front" }

--- The values of a recipe's parameters (`schema` as of lissom.params), those given or else the defaults,
-- and a table of the given options that are lissom.merge's own. Any other name is an error at the caller of
-- the recipe.
function merging.read_options(name, schema, options)
    local values, own, left = {}, {}, {}
    for key, value in pairs(options or {}) do left[key] = value end
    for key, one in pairs(schema) do
        values[key] = left[key]
        if values[key] == nil then values[key] = one.default end
        left[key] = nil
    end
    for _, key in ipairs(merge_options) do
        own[key], left[key] = left[key], nil
    end
    local unknown = next(left)
    if unknown ~= nil then
        lissom.error{ level = 3,
            message = "unknown option '" .. tostring(unknown) .. "' of '" .. name .. "'" }
    end
    return values, own
end

--- Merges joins as lissom.merge does, `options` being its other options; `fixed` may be a function that is
-- given the source and returns a list of its regions. Returns the mesh, the report and { source=, targets=,
-- joins=, warnings= }: the parts as they were joined.
function merging.merge(joins, options, warnings)
    local source, targets, seen = joins[1].source:mesh(), {}, {}
    for _, join in ipairs(joins) do
        local target = join.target:mesh()
        if not seen[target] then table.insert(targets, target) end
        seen[target] = true
    end
    local all = { joins = joins }
    for key, value in pairs(options or {}) do all[key] = value end
    if type(all.fixed) == "function" then all.fixed = all.fixed(source) end
    for _, name in ipairs(direction_options) do
        if all[name] ~= nil then all[name] = merging.direction(all[name]) end
    end
    local mesh, report = lissom.merge(all)
    return mesh, report, { source = source, targets = targets, joins = joins, warnings = warnings or {} }
end

--- Adds the warnings of a cut to a list of texts, with the name of the part. Returns the list.
function merging.note(list, name, warnings)
    for _, warning in ipairs(warnings) do table.insert(list, name .. ": " .. warning.message) end
    return list
end

--- Returns a join of two boundaries with keys by pairs of directions, or without keys if these are nil. Adds
-- warnings of ambiguous keys to a list.
function merging.joined(source, target, directions, warnings)
    if not directions then return { source = source, target = target } end
    local keys, of_keys = merging.keys(source, target, directions)
    table.move(of_keys, 1, #of_keys, #warnings + 1, warnings)
    return { source = source, target = target, keys = keys }
end

--- Parameters of merging.join, as lissom.params takes them.
merging.schema = {
    source_cut = { type = "string", default = "",
        help = "cut of the source: \"point; normal\" or \"point; normal; seed\", each x, y, z" },
    target_cut = { type = "string", default = "", help = "cut of the target" },
    keys = { type = "string", default = "",
        help = "pairs that meet: \"y = -z; ...\", directions on source and target; else the best fit" },
}

--- Cuts two models, or takes their longest open boundaries, and merges the rest of the source onto the
-- target.
-- Options: source_cut, target_cut; keys, pairs of directions; the others are those of merging.merge.
-- Returns the mesh, the report and the parts, as merging.merge.
function merging.join(source, target, options)
    local values, own = merging.read_options("join", merging.schema, options)
    local of, onto = merging.read_cut(values.source_cut), merging.read_cut(values.target_cut)
    local _, from, of_source = merging.named("source", merging.part, source, of)
    local _, to, of_target = merging.named("target", merging.part, target, onto)
    local warnings = merging.note({}, "source", of_source)
    merging.note(warnings, "target", of_target)
    local join = merging.joined(from, to, merging.read_keys(values.keys), warnings)
    return merging.merge({ join }, own, warnings)
end

-- The columns of a frame: the way out of an opening (`sign` 1) or into it, the part of a direction that is
-- square to it, and their cross product.
local function frame(boundary, direction, sign)
    local axis = plus({ 0, 0, 0 }, merging.axis(boundary), sign)
    local d = merging.direction(direction)
    local side = unit(plus(d, axis, -dot(d, axis)))
    return { axis, side, cross(axis, side) }
end

-- The axis and the angle in degrees of the rotation that takes one frame to another.
local function rotation_between(from, to)
    local m, trace = {}, 0
    for i = 1, 3 do
        m[i] = {}
        for j = 1, 3 do
            m[i][j] = to[1][i] * from[1][j] + to[2][i] * from[2][j] + to[3][i] * from[3][j]
        end
        trace = trace + m[i][i]
    end
    local angle = math.acos(math.max(-1, math.min(1, (trace - 1) / 2)))
    local axis = { m[3][2] - m[2][3], m[1][3] - m[3][1], m[2][1] - m[1][2] }
    if length(axis) < 1e-6 then
        -- Half a turn: a column of m + 1 is the axis.
        axis = { m[1][1] + 1, m[2][1], m[3][1] }
        if length(axis) < 0.5 then axis = { m[1][2], m[2][2] + 1, m[3][2] } end
        if length(axis) < 0.5 then axis = { m[1][3], m[2][3], m[3][3] + 1 } end
    end
    return axis, math.deg(angle)
end

--- A copy of the source moved, turned and scaled so that its boundary comes to lie at the target's: in the
-- middle, as long, looking at it, and with the first direction of a key (a pair) on the second. Returns the
-- copy and its boundary: the start of merging in the fixed configuration.
function merging.placed(from, to, key)
    local axis, angle = rotation_between(frame(from, key[1], 1), frame(to, key[2], -1))
    local here, there, scale = merging.center(from), merging.center(to), to:length() / from:length()
    local copy = from:mesh():copy():transform{ scale = scale, about = here }
    copy:transform{ rotate = { axis = axis, angle = angle, about = here }, translate = plus(there, here, -1) }
    local point = { copy:position(from:vertices()[1]) }
    return copy, merging.boundary_near(copy, point)
end

--- A copy of a mesh that lies elsewhere, turned and of another size, and is the same for the same number.
function merging.elsewhere(mesh, number)
    local function chance(k)
        local x = math.sin(12.9898 * number + 78.233 * k) * 43758.5453
        return 2 * (x - math.floor(x)) - 1
    end
    local scale = 10 ^ (2 * chance(1))
    local far = 5 * scale * mesh:size()
    return mesh:copy():transform{
        scale = scale,
        rotate = { axis = { chance(2), chance(3), chance(4) + 1.5 }, angle = 180 * chance(5) },
        translate = { far * chance(6), far * chance(7), far * chance(8) },
    }
end

--- Merges again from another place, turn and size of the source, by the same vertices, and returns how far
-- the vertices of the two results are apart at most, in sizes of the first.
function merging.configuration_error(mesh, parts, number, options)
    local moved, joins = merging.elsewhere(parts.source, number), {}
    for i, join in ipairs(parts.joins) do
        -- A copy has the same vertices, so that the boundary is the one through the moved vertex.
        local point = { moved:position(join.source:vertices()[1]) }
        joins[i] = { source = merging.boundary_near(moved, point), target = join.target, keys = join.keys }
    end
    local other = merging.merge(joins, options)
    if #other ~= #mesh then return math.huge end
    local p, q, greatest = mesh:positions(), other:positions(), 0
    for i = 1, #p do greatest = math.max(greatest, math.abs(p[i] - q[i])) end
    return greatest / mesh:size(), other
end

return merging
