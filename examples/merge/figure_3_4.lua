-- A head between two ears (Figure 3.4): two joins at once, whose lines undulate and are of different shape.
--
--     lissom run examples/merge/figure_3_4.lua
--     lissom run examples/merge/figure_3_4.lua --models ../shared/data/models
--
-- In the folder of models it expects skull_headus_20k.off and stanford_bunny_35k.obj.

local blocks = require "blocks"
local figures = require "figures"
local lissom = require "lissom"
local merge_script = require "merge_script"
local merging = require "merging"

local params = merge_script.params()

-- The mesh with round openings about points, and the boundary of each.
local function with_discs(mesh, points, radius)
    local discs
    for _, point in ipairs(points) do
        local disc = mesh:region{ geodesic = { from = mesh:nearest(point).vertex, radius = radius } }
        discs = discs and discs:union(disc) or disc
    end
    local open, boundaries = mesh:cut{ region = discs:invert() }, {}
    for i, point in ipairs(points) do boundaries[i] = merging.boundary_near(open, point) end
    return open, boundaries
end

-- The mesh cut by planes one after the other, and the boundary of each cut.
local function with_cuts(mesh, cuts)
    local points, boundaries = {}, {}
    for i, cut in ipairs(cuts) do
        local part, boundary = merging.part(mesh, cut)
        mesh, points[i] = part, boundary:points()[1]
    end
    for i, point in ipairs(points) do boundaries[i] = merging.boundary_near(mesh, point) end
    return mesh, boundaries
end

-- Both models, a boundary for each ear, and the joins.
local function real()
    local skull = lissom.load(params.models .. "/skull_headus_20k.off")
    local bunny = lissom.load(params.models .. "/stanford_bunny_35k.obj")
    local source, from = with_discs(skull, { { 8.9, 3, 2 }, { -5, 4, 1.5 } }, 3.4)
    local target, to = with_cuts(bunny, {
        { point = { -0.032, 0.168, -0.005 }, normal = { -1, -0.6, 0.5 }, seed = { 0, 0.05, 0 } },
        { point = { -0.07, 0.165, -0.022 }, normal = { 0.1, -0.5, 1 }, seed = { 0, 0.05, 0 } },
    })
    -- The ears point backwards and apart; between them the skull looks up.
    local up = { -0.3, 1, 0.5 }
    return source, from, target, to, { { "-y", up }, { "y", { -up[1], -up[2], -up[3] } } }
end

local function generated()
    local head = merging.part(lissom.shapes.head{ vertices = 10000 },
        { point = { 0, -0.15, 0 }, normal = { 0, 1, -0.25 }, seed = { 0, 0.1, 0 } })
    head:fill(head:boundaries()[1])
    local source, from = with_discs(head, { { 0.1, 0.03, -0.02 }, { -0.1, 0.03, -0.02 } }, 0.03)
    local target, to = with_cuts(blocks.hare(), {
        { point = { 2, 6.5, 0 }, normal = { 0.9, -1, 0 } },
        { point = { -2, 6.5, 0 }, normal = { -0.9, -1, 0 } },
    })
    return source, from, target, to, { { "z", "z" }, { "-z", "-z" } }
end

local generate = params.models ~= "" and real or generated
local source, from, target, to, directions = generate()
local joins = {}
for i = 1, 2 do
    joins[i] = { source = from[i], target = to[i], keys = merging.keys(from[i], to[i], directions) }
end
-- The boundaries undulate: a few more steps than usual take the last of it away.
local mesh, report, parts = merging.merge(joins, { seam = params.seam, smooth = 6 })
merge_script.finish(params, "figure_3_4", mesh, report, parts, { view = "front" })

figures.claim(mesh:genus() == source:genus() + target:genus() + 1, "two joins make a loop")
figures.claim(#mesh:boundaries() == #source:boundaries() + #target:boundaries() - 4, "both seams are closed")
figures.claim(report.seam.after.max_dihedral < 35, "the seams are hidden")
