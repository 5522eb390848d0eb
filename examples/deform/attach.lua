-- When to choose `attach`: buttons, eyes and clothes are meshes of their own and go where the surface below
-- goes. Buttons keep their shape; each vertex of a sleeve follows the surface nearest to it.
--
--     lissom run examples/deform/attach.lua

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    angle = { type = "number", default = 70, min = 0, max = 150, unit = "degrees",
        help = "how far the arm's end turns" },
    size = { type = "integer", default = 330, min = 80, help = "height of the picture in pixels" },
    out = { type = "folder", default = "out", help = "folder that the files go to" },
}

local arm = lissom.shapes.cylinder{ radius = 0.5, height = 5, segments = 48, rings = 60 }
local function button(height)
    return lissom.shapes.sphere{ radius = 0.13 }:transform{ translate = { 0.55, height, 0 } }
end
local buttons = button(-1.6)
for i = 1, 4 do buttons:append(button(-1.6 + 0.55 * i)) end
local sleeve = lissom.shapes.cylinder{ radius = 0.56, height = 1, segments = 48, rings = 12, caps = false }
sleeve:transform{ translate = { 0, 1.4, 0 } }

local function dressed() return arm:copy():append(buttons):append(sleeve) end
local rest = dressed()

local deformer = lissom.deformer(arm):pin(arm:region("bottom"))
deformer:attach(buttons):attach(sleeve, { mode = "vertices" })
local top = deformer:add_handle(arm:region("top"))
top:rotate("z", params.angle)
top:translate(-math.sin(math.rad(params.angle)), -params.angle / 150, 0)
deformer:solve()

figures.write{
    name = "attach", out = params.out, columns = 2, fit = "each", view = "front",
    panels = { { rest, "rest" }, { dressed(), "turned: buttons and sleeve follow" } },
    size = { 2 * params.size, params.size },
}
local center = sleeve:bounds().center
figures.claim(arm:nearest(center[1], center[2], center[3]).distance < 0.6, "the sleeve is about the arm")
