-- Two streams and a parting make the directions of a whole head of hair.
local lissom = require "lissom"

local p = lissom.params{
    parting = { type = "number", default = -25, min = -50, max = 50, unit = "degrees",
        help = "the side of the parting" },
    length = { type = "number", default = 0.26, min = 0.05, max = 0.4, unit = "metres",
        help = "of a strand" },
    lift = { type = "number", default = 0.02, min = 0.005, max = 0.05, unit = "metres",
        help = "above the head" },
    curls = { type = "number", default = 0.006, min = 0, max = 0.02, unit = "metres",
        help = "how far waves sway" },
    strands = { type = "integer", default = 8000, min = 1000, max = 40000, help = "how many" },
    color = { type = "choice", default = "brown", choices = { "black", "brown", "auburn", "blond", "silver" },
        help = "of the hair" },
}

local colors = { black = "#1b1613", brown = "#4a2f1d", auburn = "#7a3418", blond = "#b98f52",
    silver = "#a9a8a6" }

local head = lissom.shapes.head{ vertices = 8000 }
local style = lissom.hairstyle(head, { resolution = 20000 })
for _, side in ipairs{ -1, 1 } do
    style:add_stream{
        style:at{ azimuth = p.parting + 12 * side, elevation = 60, lift = p.lift },
        style:at{ azimuth = 75 * side, elevation = 35, lift = p.lift },
        style:at{ azimuth = 92 * side, elevation = -20, lift = p.lift },
        style:at{ azimuth = 96 * side, elevation = -45, lift = p.lift },
    }
end
style:add_dividing{ style:at{ azimuth = p.parting, elevation = 40 },
    style:at{ azimuth = p.parting, elevation = 80 } }

local hair = style:grow{ count = p.strands, length = p.length }
hair:clump{ clumps = 400 }:noise{}
if p.curls > 0 then hair:wave{ radius = p.curls, wavelength = 0.05 } end
hair:taper{}

lissom.render{ mesh = head, strands = hair, hair = { color = colors[p.color] }, file = "groom.png" }
return style          -- for the tools beside the picture
