-- The tool script of the engine in this folder: the engine sets its declared parameters, and draws its
-- results. A cactus with three handles, a head, and a hairstyle that the engine grows as a job.
local lissom = require "lissom"

local params = lissom.params{
    vertices = { type = "integer", default = 6000, min = 2000, max = 200000, help = "of the cactus" },
    lift = { type = "number", default = 0.02, min = 0.005, max = 0.1, unit = "m",
        help = "of the hair over the head" },
}

local cactus = lissom.shapes.cactus{ vertices = params.vertices }
local deformer = lissom.deformer(cactus)
for _, name in ipairs{ "base", "tip", "left_tip" } do deformer:add_handle(cactus:region(name)) end

local head = lissom.shapes.head{ vertices = 8000 }
local style = lissom.hairstyle(head, { resolution = 30000 })
for _, side in ipairs{ -1, 1 } do
    style:add_stream{ points = {
        style:at{ azimuth = 10 * side, elevation = 60, lift = 0.5 * params.lift },
        style:at{ azimuth = 75 * side, elevation = 35, lift = params.lift },
        style:at{ azimuth = 90 * side, elevation = -20, lift = params.lift },
    } }
end
style:add_dividing{ points = { style:at{ azimuth = 0, elevation = 40 },
    style:at{ azimuth = 0, elevation = 80 } } }

return cactus, deformer, head, style
