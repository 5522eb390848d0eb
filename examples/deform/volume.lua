-- When to choose `volume`: it keeps the thickness of solids that twist and bend, by springs across their
-- inside. Without it a twisted waist gets thin. It costs about a third of a frame.
--
--     lissom run examples/deform/volume.lua

local figures = require "figures"
local lissom = require "lissom"

local params = lissom.params{
    twist = { type = "number", default = 180, min = 0, max = 720, unit = "degrees",
        help = "how far the bar's upper end turns" },
    bend = { type = "number", default = 135, min = 0, max = 170, unit = "degrees",
        help = "how far the cactus's top turns over" },
    volume = { type = "number", default = 1, min = 0, max = 1, help = "how much of the thickness is kept" },
    size = { type = "integer", default = 330, min = 80, help = "height of the picture in pixels" },
    out = { type = "folder", default = "out", help = "folder that the files go to" },
}

local bar = lissom.shapes.bar{ length = 5, width = 1, across = 10, along = 50 }
figures.set_ends(bar, 2, 0.1)
local twist = {
    low = figures.hold,
    high = function(handle) handle:rotate{ axis = "y", angle = params.twist } end,
}

local cactus = lissom.shapes.cactus{ vertices = 4000 }
figures.set_ends(cactus, 2, 0.12)
local bend = {
    low = figures.hold,
    high = function(handle) handle:rotate{ axis = "z", angle = -params.bend } end,
}

-- A copy without and one with volume.
local function pair(rest, handles, found)
    local panels = {}
    for _, volume in ipairs{ 0, params.volume } do
        local mesh = figures.deformed(rest, { volume = volume }, handles)
        local kept = mesh:volume() / rest:volume()
        figures.row("volume " .. volume, "%8.3f", kept)
        table.insert(found, kept)
        table.insert(panels, { mesh, string.format("volume = %g: %.0f %%", volume, 100 * kept) })
    end
    return panels
end

local twisted, bent = {}, {}
figures.row("", "%8s", "volume")
local panels = pair(bar, twist, twisted)
for _, panel in ipairs(pair(cactus, bend, bent)) do table.insert(panels, panel) end
print("volume beside that at rest")

figures.write{
    name = "volume", out = params.out, panels = panels, columns = 4, fit = "each",
    size = { 3 * params.size, params.size }, handles = { "low", "high" }, wire = true, view = "front",
}
local function off(found) return math.abs(found[2] - 1) <= math.abs(found[1] - 1) end
figures.claim(off(twisted) and off(bent), "volume keeps that of a twisted bar and of a bent cactus")
