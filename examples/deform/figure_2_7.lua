-- A bar under a large rotation of its upper end (Figure 2.7): the displacement of degenerate vertices hardly
-- matters. Results of other methods for the same handles.
--
--     lissom run examples/deform/figure_2_7.lua
--     lissom run examples/deform/figure_2_7.lua --mesh bar.off --turn 150
--
-- A model given as `mesh` is held and turned at the two ends of its longest side.

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    mesh = { type = "file", default = "", help = "a model instead of the generated bar" },
    turn = { type = "number", default = 120, min = 10, max = 175, unit = "degrees",
        help = "how far the upper end turns about the axis of the bar" },
    tilt = { type = "number", default = 60, min = 0, max = 120, unit = "degrees",
        help = "how far it then turns over" },
    across = { type = "integer", default = 10, min = 4, max = 60, help = "quads across each side" },
    out = { type = "folder", default = "out", help = "folder that the files go to, made if missing" },
}

local rest = params.mesh ~= "" and lissom.load(params.mesh)
    or lissom.shapes.bar{ length = 5, across = params.across, along = 5 * params.across }

-- The longest side of the bounding box is the bar's axis; its lowest and highest eighth are the handles.
local axis = figures.longest_axis(rest)
figures.set_ends(rest, axis, 0.12)

local up = { 0, 0, 0 }
up[axis] = 1
local side = { 0, 0, 0 }
side[axis % 3 + 1] = 1
local handles = {
    low = figures.hold,
    high = function(handle)
        handle:rotate{ axis = up, angle = params.turn }
        handle:rotate{ axis = side, angle = params.tilt, about = rest:bounds().center }
    end,
}

-- The thesis's own settings keep the gradients within two rings similar, so that the displacement matters
-- little; the faster default looks at one ring.
print(string.format("%d vertices", #rest))
local function between(options)
    local shapes = {}
    for i, displacement in ipairs{ 0.2, 10 } do
        local chosen = { displacement = displacement }
        for name, value in pairs(options) do chosen[name] = value end
        shapes[i] = figures.deformed(rest, chosen, handles)
    end
    return shapes[1], shapes[2]
end
local near, far = between{ fidelity = "thesis" }
local greatest, rms = figures.difference(near, far)
print(string.format("displacement 0.2 and 10, thesis: differ by %.4f of the size at most, %.4f rms", greatest,
    rms))
figures.claim(greatest < 0.1, "the displacement hardly matters")
local own, other = between{}
print(string.format("displacement 0.2 and 10, default: differ by %.4f of the size at most, %.4f rms",
    figures.difference(own, other)))

-- The difference in colours, on the first of the two shapes.
local difference = near:copy()
local values = difference:add_attribute{ name = "difference", domain = "vertex" }
for v, d in ipairs(figures.distances(near, far)) do values[v] = d end

local panels = {
    { rest, "at rest" },
    { near, "thesis, displacement 0.2" },
    { far, "thesis, displacement 10" },
    { difference, "difference of these two" },
    { own, "implicit, default" },
}
local rows = { { "thesis", near }, { "implicit", own } }
for _, method in ipairs{ "rotation_estimate", "similarity", "harmonic", "naive" } do
    local mesh = figures.deformed(rest, { method = method }, handles)
    table.insert(rows, { method, mesh })
    if method ~= "naive" then table.insert(panels, { mesh, method }) end
end
local worst = {}
figures.row("method", "%10s %10s %10s %8s", "median", "99 %", "worst", "volume")
for _, row in ipairs(rows) do
    local a = figures.anisotropy(rest, row[2])
    worst[row[1]] = a.p99
    figures.row(row[1], "%10.3f %10.3f %10.3f %8.3f", a.p50, a.p99, a.max, row[2]:volume() / rest:volume())
end
print("anisotropy of triangles (1: kept its shape), and volume as a fraction of that at rest")

figures.write{
    name = "figure_2_7", out = params.out, panels = panels, columns = 4, size = { 1600, 1200 },
    handles = { "low", "high" }, wire = #rest < 10000, scalars = "difference", label = "of the size",
}
for _, method in ipairs{ "rotation_estimate", "similarity", "naive" } do
    figures.claim(worst.implicit < 0.8 * worst[method], "implicit distorts less than " .. method)
end
