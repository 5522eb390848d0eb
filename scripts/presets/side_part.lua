--- Long straight hair from a side parting, behind the shoulders.
--
--     lissom run scripts/presets/side_part.lua --parting 20 --length 0.2
local styling = require "styling"

local schema = styling.straight_schema(0.29)
schema.parting = { type = "number", default = -22, min = -45, max = 45, unit = "degrees",
    help = "azimuth where the parting begins: below 0 at the head's right" }

return styling.preset(..., {
    name = "side_part",
    edge = "loose",
    schema = schema,
    make = function(head, v, o)
        local a = v.parting
        local style = styling.long(head, o, styling.behind,
            { { a, 37 }, { 1.27 * a, 52 }, { 1.9 * a, 68 }, { 3.2 * a, 76 } })
        local hair = styling.straight(style, o, v)
        return style, hair, { color = "#b8894f", unit = o.scalp:unit() }
    end,
})
