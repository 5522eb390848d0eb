-- When to ask for contacts: a limb that is bent far may run through another. `contacts` finds the faces
-- that do, quickly enough for each frame of a drag; `stop = "contact"` ends the drag before they meet, and
-- `avoid` pushes them apart.
--
--     lissom run examples/deform/contacts.lua

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    angle = { type = "number", default = 75, min = 0, max = 170, unit = "degrees",
        help = "how far the trunk bows to the arm" },
    size = { type = "integer", default = 420, min = 80, help = "height of the picture in pixels" },
    out = { type = "folder", default = "out", help = "folder that the files go to" },
}

local rest = lissom.shapes.cactus{ vertices = 9000, thorns = 0 }

-- A copy whose trunk bows to its right arm, by solve(deformer).
local function bowing(solve)
    local mesh = rest:copy()
    local deformer = lissom.deformer(mesh):pin(mesh:region("base"))
    local tip = deformer:add_handle(mesh:region("tip"))
    tip:rotate{ axis = "z", angle = -params.angle, about = { 0, 0.6 * tip:center()[2], 0 } }
    local _, stop = solve(deformer)
    local found = deformer:contacts()
    mesh:set_region("contacts", found.region)
    return mesh, #found, stop
end

local through, pairs_through = bowing(function(deformer) return deformer:solve() end)
local touching, pairs_touching, stop =
    bowing(function(deformer) return deformer:solve{ stop = "contact" } end)
local apart, pairs_apart =
    bowing(function(deformer) return deformer:solve{ avoid = true } end)

figures.row("", "%8s %8s", "pairs", "way")
figures.row("solve", "%8d %8.2f", pairs_through, 1)
figures.row("stop", "%8d %8.2f", pairs_touching, stop.share)
figures.row("avoid", "%8d %8.2f", pairs_apart, 1)

figures.write{
    name = "contacts", out = params.out, columns = 4, fit = "each", view = "front",
    panels = {
        { rest, "rest" },
        { through, pairs_through .. " pairs of faces intersect" },
        { touching, string.format("stopped after %.0f %% of the way", 100 * stop.share) },
        { apart, pairs_apart .. " pairs once pushed apart" },
    },
    size = { 3 * params.size, params.size }, handles = { "contacts" },
}
figures.claim(pairs_touching == 0, "a drag that stops at contacts has none")
figures.claim(3 * pairs_apart <= pairs_through, "a push takes most contacts away")
