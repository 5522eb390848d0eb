-- If a few vertices hold a detailed region, the deformation works on a surface that is subdivided along them
-- (section 2.5 of the thesis), and the mesh keeps its faces. A tube with bumps is held at its ends, which are
-- triangles.
--
--     lissom run examples/deform/coarse_borders.lua
--     lissom run examples/deform/coarse_borders.lua --twist 90 --tilt 20

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    twist = { type = "number", default = 60, min = -170, max = 170, unit = "degrees",
        help = "how far the upper end turns about the tube" },
    tilt = { type = "number", default = 70, min = -170, max = 170, unit = "degrees",
        help = "how far it then turns over" },
    out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
}

local corners, sides, rings, height = 3, 48, 60, 6

-- Triangles between an end and a ring, the next one on the side with less of its circle behind it.
local function join(faces, first, ring, flip)
    local function add(a, b, c) table.insert(faces, flip and { b, a, c } or { a, b, c }) end
    local c, k = 0, 0
    while c < corners or k < sides do
        local corner = first + c % corners
        if k == sides or c < corners and (c + 0.5) / corners < (k + 0.5) / sides then
            add(corner, first + (c + 1) % corners, ring + k % sides)
            c = c + 1
        else
            add(ring + (k + 1) % sides, ring + k % sides, corner)
            k = k + 1
        end
    end
end

-- Vertices in rings of `sides` from bottom to top, then the corners of both ends.
local function tube()
    local positions, faces = {}, {}
    for r = 1, rings do
        for k = 0, sides - 1 do
            local a, z = 2 * math.pi * k / sides, height * r / (rings + 1)
            local radius = 1 + 0.08 * math.sin(5 * a) * math.sin(6 * math.pi * z / height)
            table.insert(positions, { radius * math.cos(a), z, -radius * math.sin(a) })
        end
    end
    for _, z in ipairs{ 0, height } do
        for c = 0, corners - 1 do
            local a = 2 * math.pi * c / corners
            table.insert(positions, { math.cos(a), z, -math.sin(a) })
        end
    end
    for r = 0, rings - 2 do
        for k = 0, sides - 1 do
            local a, b = r * sides + k + 1, r * sides + (k + 1) % sides + 1
            table.insert(faces, { a, b, b + sides })
            table.insert(faces, { a, b + sides, a + sides })
        end
    end
    join(faces, rings * sides + 1, 1, false)
    join(faces, rings * sides + corners + 1, (rings - 1) * sides + 1, true)
    return lissom.mesh{ positions = positions, faces = faces }
end

local rest = tube()
figures.set_ends(rest, 2, 1e-9)
local handles = {
    low = figures.hold,
    high = function(handle)
        handle:rotate{ axis = { 0, 1, 0 }, angle = params.twist }
        handle:rotate{ axis = { 1, 0, 0 }, angle = params.tilt }
        handle:translate(0, -1.2, 2.5)
    end,
}

local coarse = figures.deformed(rest, { subdivide_borders = false }, handles)
local refined, deformer = figures.deformed(rest, {}, handles)
local dense = deformer:subdivided_mesh()

-- Limit of both: the refined surface at rest, each of its triangles divided by four.
local still = select(2, figures.deformed(rest, {}, { low = figures.hold, high = figures.hold }))
local limit = figures.deformed(still:subdivided_mesh():subdivide(1), { subdivide_borders = false }, handles)

-- Root mean square distance between the vertices of the rings, in sizes of the tube.
local function difference(a, b)
    local p, q, squares = a:positions(), b:positions(), 0
    for i = 1, 3 * sides * rings do squares = squares + (p[i] - q[i]) ^ 2 end
    return math.sqrt(squares / (sides * rings)) / rest:size()
end

print(string.format("%d vertices, and %d inserted along the borders", #rest,
    deformer:stats().subdivided_vertices))
figures.row("border", "%14s", "from the limit")
local without, with = difference(coarse, limit), difference(refined, limit)
figures.row("as it is", "%14.4f", without)
figures.row("refined", "%14.4f", with)

figures.write{
    name = "coarse_borders", out = params.out, columns = 4, size = { 1800, 620 }, view = "three-quarter",
    handles = { "low", "high" }, wire = true,
    panels = { { rest, "at rest" }, { coarse, "coarse borders" }, { refined, "refined borders" },
        { dense, "the refined mesh" } },
}
figures.claim(deformer:stats().subdivided_vertices > 0, "a coarse border is refined")
figures.claim(#refined == #rest, "the mesh keeps its vertices")
figures.claim(with < without, "refined borders are nearer to the limit")
