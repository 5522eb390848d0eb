--- One part many times over a surface: scales, spikes, leaves.
--
--     lissom run scripts/recipes/scatter.lua --part spike --count 200 --seed 3
--     lissom run scripts/recipes/scatter.lua --part scale --target fish.obj --count 400 --toward -z --turn 10
--
--     local scatter = require "recipes.scatter"
--     local mesh, report = scatter.make(parts.make("leaf"), model, { count = 100, seed = 1 })
--
-- Places are spread evenly: each is the one of many random points that is farthest from those before it. So
-- the first hundred are the same for any count, and so are their angles and sizes if `size` is given.
local lissom = require "lissom"
local merging = require "merging"
local parts = require "parts"
local vectors = require "vectors"

local scatter = {}

--- Parameters, as lissom.params takes them.
scatter.schema = {
    count = { type = "integer", default = 100, min = 1, max = 20000, help = "places" },
    density = { type = "number", default = 0, min = 0,
        help = "places a square of the target's size (its RMS distance from the middle); 0: see count" },
    seed = { type = "integer", default = 1, min = 1, max = 2147483646, help = "another one, other places" },
    size = { type = "number", default = 0, min = 0,
        help = "radius of a part on the target; 0: such that parts nearly touch" },
    vary = { type = "number", default = 0.2, min = 0, max = 0.9,
        help = "how much sizes differ, as a part of them" },
    toward = { type = "string", default = "", help = "the way on the target that is up for parts" },
    turn = { type = "number", default = 180, min = 0, max = 180, unit = "degrees",
        help = "how much angles differ from that way, to both sides" },
    margin = { type = "number", default = 1, min = 0, max = 10, unit = "radii of a part",
        help = "places keep this far from open boundaries" },
    candidates = { type = "integer", default = 6000, min = 1, max = 1000000,
        help = "random points that places are chosen from; six times as many as places, at least" },
}

-- Numbers from 0 to 1 that depend on the seed alone (Park and Miller's generator).
local function random(seed)
    local state = seed % 2147483647
    if state == 0 then state = 1 end
    local function next()
        state = state * 16807 % 2147483647
        return state / 2147483647
    end
    for _ = 1, 8 do next() end
    return next
end

-- The area of each triangle of a mesh, summed up to it, and the triangles.
local function summed_areas(mesh, inside)
    local triangles, sums, sum = {}, {}, 0
    local positions = mesh:positions()
    local function at(v) return { positions[3 * v - 2], positions[3 * v - 1], positions[3 * v] } end
    for _, face in ipairs(mesh:faces()) do
        for k = 2, #face - 1 do
            if not inside or (inside:contains(face[1]) and inside:contains(face[k])
                and inside:contains(face[k + 1])) then
                local a, b, c = at(face[1]), at(face[k]), at(face[k + 1])
                local normal = vectors.cross(vectors.plus(b, a, -1), vectors.plus(c, a, -1))
                local area = vectors.length(normal) / 2
                if area > 0 then
                    sum = sum + area
                    table.insert(triangles, { a, b, c, vectors.plus({ 0, 0, 0 }, normal, 0.5 / area) })
                    table.insert(sums, sum)
                end
            end
        end
    end
    return triangles, sums, sum
end

local function first_above(sums, value)
    local low, high = 1, #sums
    while low < high do
        local middle = math.floor((low + high) / 2)
        if sums[middle] < value then low = middle + 1 else high = middle end
    end
    return low
end

-- Random points of a surface, evenly by area, with their normals.
local function points_on(triangles, sums, count, next)
    local points = {}
    for i = 1, count do
        local triangle = triangles[first_above(sums, next() * sums[#sums])]
        local u, v = next(), next()
        if u + v > 1 then u, v = 1 - u, 1 - v end
        local p = {}
        for k = 1, 3 do
            local a, b, c = triangle[1][k], triangle[2][k], triangle[3][k]
            p[k] = a + u * (b - a) + v * (c - a)
        end
        points[i] = { p, triangle[4] }
    end
    return points
end

--- Places on a mesh: a list of points, each as far as can be from those before it, and the distance between
-- neighbours if they were a perfect pattern. Points of surfaces that look in opposite directions, as on both
-- sides of a leaf, count as farther apart. Options: count, seed, candidates, region (of the mesh).
function scatter.places(mesh, options)
    local triangles, sums, area = summed_areas(mesh, options.region)
    if #triangles == 0 then lissom.error{ message = "there is no surface to scatter over", level = 2 } end
    local next = random(options.seed or 1)
    local points = points_on(triangles, sums, options.candidates or scatter.schema.candidates.default, next)
    local count = math.min(options.count, #points)
    local nearest, places = {}, {}
    for i = 1, #points do nearest[i] = math.huge end
    local chosen = 1
    for n = 1, count do
        local p, normal = points[chosen][1], points[chosen][2]
        places[n] = p
        local px, py, pz, nx, ny, nz = p[1], p[2], p[3], normal[1], normal[2], normal[3]
        local best = -1
        for i = 1, #points do
            local q, m = points[i][1], points[i][2]
            local dx, dy, dz = q[1] - px, q[2] - py, q[3] - pz
            local d = (dx * dx + dy * dy + dz * dz) * (2 - nx * m[1] - ny * m[2] - nz * m[3])
            if d < nearest[i] then nearest[i] = d end
            if nearest[i] > best then best, chosen = nearest[i], i end
        end
    end
    return places, math.sqrt(2 / math.sqrt(3) * area / count)
end

-- How far a part reaches over its plate from its middle.
local function radius_of(part)
    local center, far = (part.feature or part.region):center(), 0
    for _, loop in ipairs(part.region:boundaries()) do
        for _, p in ipairs(loop:points()) do
            far = math.max(far, vectors.length(vectors.plus(p, center, -1)))
        end
    end
    return far
end

-- Angle and relative size of each place, which depend on the seed and its number alone.
local function varied(count, values)
    local angles, sizes = {}, {}
    for i = 1, count do
        local next = random(values.seed * 7919 + i * 104729)
        angles[i] = values.turn * (2 * next() - 1)
        sizes[i] = 1 + values.vary * (2 * next() - 1)
    end
    return angles, sizes
end

-- Returns the region far enough from open boundaries; nil if there are none.
local function inner(mesh, margin)
    local edges = {}
    for _, boundary in ipairs(mesh:boundaries()) do
        for _, v in ipairs(boundary:vertices()) do table.insert(edges, v) end
    end
    if #edges == 0 or margin == 0 then return nil end
    return mesh:region{ geodesic = { from = edges, radius = margin } }:invert()
end

--- Scatters a part, as parts.make or lissom.part.load return it, over a mesh. `options` are values of the
-- schema and `region`, the part of the target that has places. Returns the mesh and the report of
-- lissom.scatter with `places`, `angles` and `scales`.
function scatter.make(part, target, options)
    local own = {}
    for key, value in pairs(options or {}) do own[key] = value end
    local region = own.region
    own.region = nil
    local values, rest = merging.read_options("scatter", scatter.schema, own)
    if next(rest) then
        lissom.error{ message = "unknown option '" .. next(rest) .. "' of 'scatter'", level = 2 }
    end
    local count = values.count
    if values.density > 0 then
        count = math.max(1, math.floor(values.density * target:area() / target:size() ^ 2 + 0.5))
    end
    local radius = values.size
    if radius == 0 then
        local spacing = math.sqrt(2 / math.sqrt(3) * target:area() / count)
        radius = 0.42 * spacing / (1 + values.vary)
    end
    local allowed = inner(target, values.margin * radius)
    if region and allowed then allowed = allowed:intersect(region) end
    local places = scatter.places(target, { count = count, seed = values.seed, region = allowed or region,
        candidates = math.max(values.candidates, 6 * count) })
    local angles, sizes = varied(#places, values)
    local unit = radius / radius_of(part)
    for i = 1, #sizes do sizes[i] = sizes[i] * unit end
    local toward = values.toward ~= "" and merging.direction(values.toward) or part.up
    local mesh, report = lissom.scatter{ source = part.mesh, target = target, region = part.region,
        feature = part.feature, at = places, angles = angles, scales = sizes, toward = { toward },
        up = part.up }
    report.places, report.angles, report.scales = places, angles, sizes
    return mesh, report
end

--- A generated part, a generated target, and options that cover it.
function scatter.example(name)
    local target = lissom.shapes.sphere{ segments = 40, kind = "triangles" }
    target:transform{ scale = { 1.5, 1, 1 } }
    return parts.make(name or "spike", { segments = 14 }), target, { count = 60 }
end

local script_schema = {
    part = { type = "choice", default = "spike", choices = parts.names, help = "a generated part" },
    source = { type = "file", default = "", help = "a part file instead" },
    target = { type = "file", default = "", help = "the model, instead of a generated one" },
    levels = { type = "integer", default = 0, min = 0, max = 3,
        help = "Loop subdivisions of the model first" },
    out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
    picture = { type = "integer", default = 640, min = 64, max = 4096, unit = "pixels", help = "size" },
}

-- A line a reason, with how many places it is of.
local function print_refused(refused)
    local counts, order = {}, {}
    for _, one in ipairs(refused) do
        local reason = one.message:gsub("place %d+", "another place")
        if not counts[reason] then table.insert(order, reason) end
        counts[reason] = (counts[reason] or 0) + 1
    end
    for _, reason in ipairs(order) do print(string.format("  %d refused: %s", counts[reason], reason)) end
end

local function run()
    local all = {}
    for _, list in ipairs{ script_schema, scatter.schema } do
        for name, one in pairs(list) do all[name] = one end
    end
    local params = lissom.params(all)
    local part, target, options = scatter.example(params.part)
    if params.source ~= "" then part = lissom.part.load(params.source) end
    if params.target ~= "" then target, options = lissom.load(params.target), {} end
    target = target:subdivide(params.levels, { scheme = "loop" })
    for name, one in pairs(scatter.schema) do
        if params[name] ~= one.default then options[name] = params[name] end
    end
    local start = os.clock()
    local mesh, report = scatter.make(part, target, options)
    print(string.format("%d parts of %d places in %.1f s, %d rounds: %d vertices, %d faces",
        #report.places - #report.refused, #report.places, os.clock() - start, report.rounds, #mesh,
        mesh:face_count()))
    print(report)
    print_refused(report.refused)
    print(mesh:save(params.out .. "/scatter.obj"))
    local colored = mesh:copy()
    for _, name in ipairs{ "color", "normal" } do colored:remove_attribute(name) end
    local colors = colored:add_attribute{ name = "color", domain = "vertex", width = 4 }
    for v = 1, #colored do
        local color = report.parts:contains(v) and { 0.86, 0.70, 0.46, 1 } or { 0.42, 0.58, 0.80, 1 }
        for k = 1, 4 do colors[4 * v - 4 + k] = color[k] end
    end
    print(lissom.render{ mesh = colored, size = { params.picture, params.picture },
        file = params.out .. "/scatter.png" })
end

if ... ~= "recipes.scatter" then run() end

return scatter
