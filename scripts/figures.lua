--- Numbers and pictures that compare deformed copies of one mesh.
--
--     local figures = require "figures"
--     print(figures.anisotropy(rest, mesh).p99, figures.turn(rest, mesh, mesh:region("tip")))
--     figures.write{ name = "bar", out = "out", panels = { { rest, "at rest" }, { mesh, "bent" } } }
local lissom = require "lissom"

local figures = {}

-- ---- Vectors

local function minus(a, b) return { a[1] - b[1], a[2] - b[2], a[3] - b[3] } end

local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end

local function cross(a, b)
    return { a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1] }
end

local function length(a) return math.sqrt(dot(a, a)) end

local function at(positions, vertex)
    return { positions[3 * vertex - 2], positions[3 * vertex - 1], positions[3 * vertex] }
end

-- ---- Distances and distortion

--- Greatest and root mean square distance between the same vertices of two meshes, in sizes of the first.
function figures.difference(a, b)
    local p, q = a:positions(), b:positions()
    local greatest, squares = 0, 0
    for i = 1, #p, 3 do
        local d2 = (p[i] - q[i]) ^ 2 + (p[i + 1] - q[i + 1]) ^ 2 + (p[i + 2] - q[i + 2]) ^ 2
        greatest = math.max(greatest, d2)
        squares = squares + d2
    end
    local size = a:size()
    return math.sqrt(greatest) / size, math.sqrt(squares / (#p / 3)) / size
end

--- Distance of each vertex of `a` to the same vertex of `b`, in sizes of `a`: a list for colours.
function figures.distances(a, b)
    local p, q, size = a:positions(), b:positions(), a:size()
    local list = {}
    for v = 1, #a do list[v] = length(minus(at(p, v), at(q, v))) / size end
    return list
end

-- Calls visit(a, b, c) with the corners of triangles that fan each face.
local function each_triangle(mesh, visit)
    for _, face in ipairs(mesh:faces()) do
        for k = 2, #face - 1 do visit(face[1], face[k], face[k + 1]) end
    end
end

-- The triangle's first edge along x, its second (x, y) in the plane.
local function flattened(positions, a, b, c)
    local u, v = minus(at(positions, b), at(positions, a)), minus(at(positions, c), at(positions, a))
    local base = length(u)
    return base, dot(u, v) / base, length(cross(u, v)) / base
end

-- Greatest and least stretch of a triangle.
local function stretches(p, q, a, b, c)
    local base, x, y = flattened(p, a, b, c)
    local base2, x2, y2 = flattened(q, a, b, c)
    -- [base2 x2; 0 y2] [base x; 0 y]^-1 = [m n; 0 k], whose singular values these are.
    local m, k = base2 / base, y2 / y
    local n = (x2 - m * x) / y
    local sum, product = m * m + n * n + k * k, m * k
    local root = math.sqrt(math.max(0, sum * sum - 4 * product * product))
    local greatest = math.sqrt((sum + root) / 2)
    return greatest, greatest > 0 and product / greatest or 0
end

local function percentiles(list)
    table.sort(list)
    local function pick(share) return list[math.max(1, math.ceil(share * #list))] end
    return { p50 = pick(0.5), p99 = pick(0.99), max = list[#list] }
end

--- Returns how unevenly triangles were stretched: the ratio of greatest to least stretch, 1 if it kept its
-- shape, as { p50, p99, max } over all triangles.
function figures.anisotropy(rest, mesh)
    local p, q, ratios = rest:positions(), mesh:positions(), {}
    each_triangle(rest, function(a, b, c)
        local greatest, least = stretches(p, q, a, b, c)
        -- Neither triangles without an area at rest nor those with one in a rounding error say anything.
        if greatest == greatest and greatest < math.huge then
            table.insert(ratios, math.min(greatest / math.max(least, 1e-9), 1e9))
        end
    end)
    return percentiles(ratios)
end

--- Calls visit(degrees) for each edge between two faces, with the angle between their normals.
function figures.each_fold(mesh, visit)
    local positions, normals = mesh:positions(), {}
    each_triangle(mesh, function(a, b, c)
        local p = at(positions, a)
        local normal = cross(minus(at(positions, b), p), minus(at(positions, c), p))
        for _, edge in ipairs{ { a, b }, { b, c }, { c, a } } do
            local key = math.min(edge[1], edge[2]) * (#mesh + 1) + math.max(edge[1], edge[2])
            local other = normals[key]
            if other then visit(math.deg(math.atan(length(cross(normal, other)), dot(normal, other)))) end
            normals[key] = normal
        end
    end)
end

--- The mean angle between the faces at an edge, in degrees, and the number of edges folded by more than 90.
function figures.roughness(mesh)
    local sum, count, folds = 0, 0, 0
    figures.each_fold(mesh, function(degrees)
        sum, count = sum + degrees, count + 1
        if degrees > 90 then folds = folds + 1 end
    end)
    return sum / count, folds
end

-- ---- Rotations

local function mean(positions, vertices)
    local sum = { 0, 0, 0 }
    for _, v in ipairs(vertices) do
        local p = at(positions, v)
        for d = 1, 3 do sum[d] = sum[d] + p[d] / #vertices end
    end
    return sum
end

-- Top eigenvector of a symmetric 4 x 4 matrix, by power iteration on a shifted copy.
local function top_eigenvector(m)
    local shift = 0
    for i = 1, 4 do
        for j = 1, 4 do shift = shift + math.abs(m[i][j]) end
    end
    local x = { 1, 0.01, 0.02, 0.03 }
    for _ = 1, 2000 do
        local y, norm = {}, 0
        for i = 1, 4 do
            y[i] = shift * x[i]
            for j = 1, 4 do y[i] = y[i] + m[i][j] * x[j] end
            norm = norm + y[i] * y[i]
        end
        for i = 1, 4 do x[i] = y[i] / math.sqrt(norm) end
    end
    return x
end

-- The quaternion {w, x, y, z} of the rotation nearest to the motion of the vertices from p to q (Horn 1987).
local function fit(p, q, vertices)
    local from, to = mean(p, vertices), mean(q, vertices)
    local s = { { 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 0 } }
    for _, v in ipairs(vertices) do
        local a, b = minus(at(p, v), from), minus(at(q, v), to)
        for i = 1, 3 do
            for j = 1, 3 do s[i][j] = s[i][j] + a[i] * b[j] end
        end
    end
    return top_eigenvector{
        { s[1][1] + s[2][2] + s[3][3], s[2][3] - s[3][2], s[3][1] - s[1][3], s[1][2] - s[2][1] },
        { s[2][3] - s[3][2], s[1][1] - s[2][2] - s[3][3], s[1][2] + s[2][1], s[3][1] + s[1][3] },
        { s[3][1] - s[1][3], s[1][2] + s[2][1], s[2][2] - s[1][1] - s[3][3], s[2][3] + s[3][2] },
        { s[1][2] - s[2][1], s[3][1] + s[1][3], s[2][3] + s[3][2], s[3][3] - s[1][1] - s[2][2] },
    }
end

--- Returns how far a part turned, in degrees: the angle of the rotation that fits the motion of its vertices
-- best.
function figures.turn(rest, mesh, region)
    local r = fit(rest:positions(), mesh:positions(), region:vertices())
    return math.deg(2 * math.atan(length{ r[2], r[3], r[4] }, math.abs(r[1])))
end

-- The angle between two directions in degrees.
local function angle(a, b) return math.deg(math.atan(length(cross(a, b)), dot(a, b))) end

-- From the middle of one region to that of another.
local function direction(mesh, a, b)
    local positions = mesh:positions()
    return minus(mean(positions, b:vertices()), mean(positions, a:vertices()))
end

--- How far the line through the middles of two regions turned, in degrees.
function figures.bearing(rest, mesh, a, b)
    return angle(direction(rest, a, b), direction(mesh, a, b))
end

--- The angle between two such lines, each given as { a, b }, in degrees.
function figures.angle_between(mesh, first, second)
    return angle(direction(mesh, first[1], first[2]), direction(mesh, second[1], second[2]))
end

-- ---- Deformation

--- The longest side of the bounding box: 1, 2 or 3 for x, y or z.
function figures.longest_axis(mesh)
    local box, axis = mesh:bounds(), 1
    for d = 2, 3 do
        if box.max[d] - box.min[d] > box.max[axis] - box.min[axis] then axis = d end
    end
    return axis
end

--- Names the vertices in the first and the last `share` of the bounding box along an axis "low" and "high".
function figures.set_ends(mesh, axis, share)
    local box = mesh:bounds()
    local function slab(from, to)
        return mesh:region{ where = function(_, ...)
            local t = (select(axis, ...) - box.min[axis]) / (box.max[axis] - box.min[axis])
            return t >= from and t <= to
        end }
    end
    mesh:set_region("low", slab(0, share)):set_region("high", slab(1 - share, 1))
end

--- Copies `rest`, deforms the copy and returns it. options: those of lissom.deformer, with `region` a name;
-- handles: name of a region = function(handle) that moves it; `preview` true for the first system only.
function figures.deformed(rest, options, handles, preview)
    local mesh, chosen = rest:copy(), {}
    for key, value in pairs(options) do chosen[key] = value end
    if chosen.region then chosen.region = mesh:region(chosen.region) end
    local deformer = lissom.deformer(mesh, chosen)
    -- In the order of their names, so that a run repeats another to the bit.
    local names = {}
    for name in pairs(handles) do table.insert(names, name) end
    table.sort(names)
    for _, name in ipairs(names) do handles[name](deformer:add_handle(mesh:region(name))) end
    assert(preview and deformer:preview() or not preview and deformer:solve())
    return mesh, deformer
end

--- For handles that keep their place.
function figures.hold() end

-- ---- Pictures and claims

--- Draws panels = { { mesh, caption }, ... } side by side into OUT/NAME.png. The other options are those of
-- lissom.render.
function figures.write(options)
    local render, meshes, captions = {}, {}, {}
    for key, value in pairs(options) do render[key] = value end
    for _, panel in ipairs(options.panels) do
        table.insert(meshes, panel[1])
        table.insert(captions, panel[2])
    end
    render.name, render.out, render.panels = nil, nil, nil
    render.meshes, render.captions = meshes, captions
    render.columns = options.columns or #meshes
    render.file = (options.out or "out") .. "/" .. options.name .. ".png"
    print(lissom.render(render))
end

--- Prints a row of a table: a name of 24 letters and the numbers.
function figures.row(name, format, ...)
    print(string.format("%-24s " .. format, name, ...))
end

--- Raises an error that names the claim if it does not hold.
function figures.claim(holds, text)
    if not holds then lissom.error{ message = "the figure does not show that " .. text, level = 2 } end
end

return figures
