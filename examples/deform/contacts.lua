-- When to ask for contacts: a limb that is bent far may run through the body. `contacts` finds the faces that
-- do, quickly enough for each frame of a drag; `stop = "contact"` ends the drag before they meet.
--
--     lissom run examples/deform/contacts.lua

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    angle = { type = "number", default = 125, min = 0, max = 170, unit = "degrees",
        help = "how far the arm's tip turns towards the trunk" },
    size = { type = "integer", default = 420, min = 80, help = "height of the picture in pixels" },
    out = { type = "folder", default = "out", help = "folder that the files go to" },
}

local rest = lissom.shapes.cactus{ vertices = 9000, thorns = 0 }

-- A copy whose right arm leans towards the trunk, by solve(deformer).
local function leaning(solve)
    local mesh = rest:copy()
    local deformer = lissom.deformer(mesh):pin(mesh:region("base")):pin(mesh:region("tip"))
    local arm = deformer:add_handle(mesh:region("right_tip"))
    local x, y = arm:center()[1], arm:center()[2]
    arm:rotate{ axis = "z", angle = params.angle, about = { 0.75 * x, 0.7 * y, 0 } }
    local _, stop = solve(deformer)
    local found = deformer:contacts()
    mesh:set_region("contacts", found.region)
    return mesh, #found, stop
end

local through, pairs_through = leaning(function(deformer) return deformer:solve() end)
local touching, pairs_touching, stop =
    leaning(function(deformer) return deformer:solve{ stop = "contact" } end)

figures.row("", "%8s %8s", "pairs", "way")
figures.row("solve", "%8d %8.2f", pairs_through, 1)
figures.row("stop", "%8d %8.2f", pairs_touching, stop.share)

figures.write{
    name = "contacts", out = params.out, columns = 3, fit = "each", view = "front",
    panels = {
        { rest, "rest" },
        { through, pairs_through .. " pairs of faces intersect" },
        { touching, string.format("stopped after %.0f %% of the way", 100 * stop.share) },
    },
    size = { 2 * params.size, params.size }, handles = { "contacts" },
}
figures.claim(pairs_touching == 0, "a drag that stops at contacts has none")
