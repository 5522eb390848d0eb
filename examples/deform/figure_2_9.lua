-- A pose by rigid motions of four handles (Figure 2.9), from two sides, and without shear removal.
--
--     lissom run examples/deform/figure_2_9.lua
--     lissom run examples/deform/figure_2_9.lua --mesh armadillo.obj
--
-- A model given as `mesh` is taken to be the armadillo of the Stanford 3D Scanning Repository, upright along
-- y and facing +z.

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    mesh = { type = "file", default = "", help = "the armadillo, instead of the generated cactus" },
    strength = { type = "number", default = 1, min = 0, max = 1.5, help = "factor of all angles" },
    vertices = { type = "integer", default = 6000, min = 2000, max = 100000,
        help = "vertices of the cactus" },
    out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
}

-- Points as fractions of the bounding box.
local function points_of(mesh)
    local box = mesh:bounds()
    return function(x, y, z)
        local f, point = { x, y, z }, {}
        for d = 1, 3 do point[d] = box.min[d] + f[d] * (box.max[d] - box.min[d]) end
        return point
    end
end

local function turned(axis, angle, about)
    return function(handle)
        handle:rotate{ axis = axis, angle = params.strength * angle, about = about }
    end
end

-- Trunk and arms of the cactus; the foot holds.
local function cactus()
    local mesh = lissom.shapes.cactus{ vertices = params.vertices }
    local at = points_of(mesh)
    mesh:set_region("foot", mesh:region{ plane = { point = at(0, 0.12, 0), normal = { 0, -1, 0 } } })
    local tip = turned("z", -80, at(0.5, 0.62, 0.5))
    return mesh, {
        foot = figures.hold,
        tip = function(handle)
            handle:rotate{ axis = "y", angle = params.strength * 70 }
            tip(handle)
        end,
        left_tip = turned("z", 100, at(0.2, 0.45, 0.5)),
        right_tip = turned("z", -70, at(0.8, 0.45, 0.5)),
    }
end

-- Feet, both hands and the head of the armadillo.
local function armadillo()
    local mesh = lissom.load(params.mesh)
    local at, size = points_of(mesh), mesh:size()
    local function ball(center, radius)
        return mesh:region{ sphere = { center = center, radius = radius * size } }
    end
    mesh:set_region("feet", mesh:region{ plane = { point = at(0.5, 0.1, 0.5), normal = { 0, -1, 0 } } })
    mesh:set_region("left_hand", ball(at(0.97, 0.83, 0.87), 0.36))
    mesh:set_region("right_hand", ball(at(0.05, 0.86, 0.87), 0.36))
    mesh:set_region("head", ball(at(0.52, 0.82, 0.75), 0.4))
    return mesh, {
        feet = figures.hold,
        left_hand = turned("z", 75, at(0.70, 0.72, 0.5)),
        right_hand = turned("z", 85, at(0.30, 0.72, 0.5)),
        head = turned("y", -70, at(0.5, 0.8, 0.5)),
    }
end

local rest, handles = (params.mesh == "" and cactus or armadillo)()
local names = {}
for name in pairs(handles) do table.insert(names, name) end

local sheared = figures.deformed(rest, {}, handles, true)
local posed, deformer = figures.deformed(rest, {}, handles)
print(string.format("%d vertices, %d of them free, %d handles", #rest, deformer:stats().free_vertices,
    #names))
figures.row("anisotropy of triangles", "%8s %8s %8s", "median", "99 %", "worst")
local found = {}
for i, row in ipairs{ { "without shear removal", sheared }, { "with shear removal", posed } } do
    found[i] = figures.anisotropy(rest, row[2])
    figures.row(row[1], "%8.3f %8.3f %8.3f", found[i].p50, found[i].p99, found[i].max)
end

-- The same side for all but one panel, which is seen from the left by turning the model.
local turned_copy = posed:copy():transform{
    rotate = { axis = "y", angle = 60, about = rest:bounds().center },
}
figures.write{
    name = "figure_2_9", out = params.out, columns = 4, size = { 1800, 620 }, view = "front", handles = names,
    panels = {
        { rest, "(a) four handles" }, { turned_copy, "(b) posed, from the side" }, { posed, "(c) posed" },
        { sheared, "(d) without shear removal" },
    },
}
local less = found[2].p50 < found[1].p50 and found[2].p99 < found[1].p99
figures.claim(less, "the second system takes shear out")
