-- Bends a model along its longest side: its lower end stays, the upper one turns over.
--
--     lissom run examples/batch/bend.lua --mesh chair.obj --angle 40 --out bent.obj
--     lissom batch examples/batch/bend.lua --over 'props/*.obj' --sweep angle=-30,0,30 \
--         --out 'out/{name}_{angle}.obj'
local lissom = require "lissom"

local params = lissom.params{
    mesh = { type = "file", help = "the model" },
    angle = { type = "number", default = 30, min = -120, max = 120, unit = "degrees",
        help = "turn of the upper end" },
    ends = { type = "number", default = 0.15, min = 0.02, max = 0.45,
        help = "length of each end, as a part of the whole" },
    out = { type = "file", default = "bent.obj", help = "the result; a .png beside it shows it" },
}

-- Index of the longest side of a box.
local function longest(box)
    local best = 1
    for axis = 2, 3 do
        if box.max[axis] - box.min[axis] > box.max[best] - box.min[best] then best = axis end
    end
    return best
end

local mesh = lissom.load(params.mesh)
local axis = longest(mesh:bounds())
local top, bottom = {}, {}
bottom[axis], top[axis] = params.ends, 1 - params.ends
local lower = mesh:region{ fraction = { max = bottom } }
local upper = mesh:region{ fraction = { min = top } }
-- The turn is about the middle, across the model.
lissom.deform(mesh, {
    pin = lower,
    handles = { { region = upper,
        rotate = { axis = axis == 3 and "x" or "z", angle = params.angle, about = mesh:bounds().center } } },
})
mesh:save(params.out)
if lissom.render then
    lissom.render{ mesh = mesh, file = (params.out:gsub("%.%w+$", "")) .. ".png", size = { 320, 320 } }
end
