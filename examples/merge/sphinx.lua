-- A head on a body with four legs: both are generated, cut through the neck and merged.
--
--     lissom run examples/merge/sphinx.lua
--     lissom run examples/merge/sphinx.lua --turn 60 --seam fair --out /tmp

local blocks = require "blocks"
local lissom = require "lissom"
local merge_script = require "merge_script"
local transplant_head = require "recipes.transplant_head"

local params = merge_script.params{
    turn = { type = "number", default = 25, min = -90, max = 90, unit = "degrees",
        help = "how far the head looks to its left" },
    legs = { type = "integer", default = 3, min = 1, max = 8, help = "length of the legs" },
}

-- The head is 40 cm high, the body nine units: the merge finds size, place and direction by itself.
local head = lissom.shapes.head{ vertices = 10000 }
local body = blocks.beast{ legs = params.legs }

local mesh, report, parts = transplant_head.make(head, body, {
    -- The cut keeps the side of the seed. The body has an opening at its neck and needs no cut.
    source_cut = { point = { 0, -0.15, 0 }, normal = { 0, 1, -0.25 }, seed = { 0, 0.1, 0 } },
    turn = params.turn,
    seam = params.seam,
})

assert(mesh:is_closed() and mesh:is_manifold())
merge_script.finish(params, "sphinx", mesh, report, parts)
