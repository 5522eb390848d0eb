-- A bar twists by more than a turn and keeps its volume: compare with volume = 0.
local lissom = require "lissom"

local p = lissom.params{
    twist = { type = "number", default = 270, min = -720, max = 720, unit = "degrees",
        help = "how far the end turns" },
    bend = { type = "number", default = 40, min = -120, max = 120, unit = "degrees",
        help = "how far it bends" },
    volume = { type = "number", default = 1, min = 0, max = 1, help = "share of the thickness that is kept" },
}

local bar = lissom.shapes.bar{ length = 5, width = 1, across = 10, along = 50 }
local low, high = bar:bounds().min, bar:bounds().max
local function slab(from, to)
    return bar:region{ box = { min = { -9, from, -9 }, max = { 9, to, 9 } } }
end

local deformer = lissom.deformer(bar, { volume = p.volume })
deformer:pin(slab(low[2], low[2] + 0.1))
local top = deformer:add_handle(slab(high[2] - 0.1, high[2]))
top:rotate{ axis = "y", angle = p.twist }
top:rotate{ axis = "z", angle = p.bend, about = { 0, 0, 0 } }
deformer:solve()

-- How much each vertex has moved, as colours.
local rest, moved = lissom.shapes.bar{ length = 5, width = 1, across = 10, along = 50 }, {}
for v = 1, bar:vertex_count() do
    local x, y, z = bar:position(v)
    local a, b, c = rest:position(v)
    moved[v] = math.sqrt((x - a) ^ 2 + (y - b) ^ 2 + (z - c) ^ 2)
end
lissom.render{ mesh = bar, file = "twist.png", scalars = moved, wire = true }
