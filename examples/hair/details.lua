--- Local details of examples (section 4.7 of the thesis): smooth hair, and the same with the curls of a file.
--
--     lissom run examples/hair/details.lua
--     lissom run examples/hair/details.lua --example curls.hair --scale 1.5
local lissom = require "lissom"
local styling = require "styling"

local params = lissom.params{
    example = { type = "string", default = "", help = "a file of hair with details, else curls made here" },
    scale = { type = "number", default = 1, min = 0.2, max = 5, help = "size of the details" },
    count = { type = "integer", default = 12000, min = 100, help = "strands" },
    size = { type = "integer", default = 400, min = 64, help = "pixels of a picture" },
    out = { type = "folder", default = "out", help = "folder of details.png and the example" },
}

local head = lissom.shapes.head{ vertices = 12000 }
local scalp = lissom.scalp(head)
local style = styling.long(head, { scalp = scalp, resolution = 40000 }, styling.over_shoulders,
    { { 0, 37 }, { 0, 60 }, { 0, 84 } })
local smooth = style:grow{ count = params.count, length = 0.34, layer = 0.01, clearance = 0.003 }
smooth:resample{ step = 0.006 }:smooth{ iterations = 4 }:guides{ count = 500 }

-- Thirty strands with curls of chance, whose details alone are a file like any other.
local example = params.example
if example == "" then
    example = params.out .. "/curls.hair"
    local curled = style:grow{ count = 30, length = 0.3 }
    curled:curl{ radius = 0.0045, wavelength = 0.022, ramp = 0.1, start = 0.04, variation = 0.5 }
    curled:details():save(example)
end
local curly = smooth:copy():detail{ from = example, scale = params.scale, turn = 1 }
local strands = { smooth, curly }
for _, hair in ipairs(strands) do
    hair:cut{ hem = { { 0, -0.17 } }, scalp = scalp, jitter = 0.01, guide_jitter = 0.01 }
    styling.set_width(hair, 0.00026):taper{ tip = 0.4, start = 0.6 }
    hair:push_out{ head = style, clearance = 0.002 }
    hair:set_colors{ color = styling.linear(styling.colors.auburn) }
end
local target, front, up, eye = scalp:from_metres(0, -0.06, 0), scalp:front(), scalp:up(), {}
for k = 1, 3 do eye[k] = target[k] + (1.2 * front[k] + 0.1 * up[k]) / scalp:unit() end
lissom.render{
    meshes = { head, head }, color = "clay", strands = strands, columns = 2,
    captions = { "smooth", "with details" }, background = "#c8ccd2", hair = { unit = scalp:unit() },
    camera = lissom.camera{ eye = eye, target = target, up = up, fov = 24 },
    file = params.out .. "/details.png", size = { 2 * params.size, params.size },
}
