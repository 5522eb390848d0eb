--- Long straight hair from a centre parting, behind the shoulders.
--
--     lissom run scripts/presets/centre_part.lua --length 0.25
local styling = require "styling"

local schema = styling.straight_schema(0.29)
schema.parting = { type = "number", default = 82, min = 45, max = 88, unit = "degrees",
    help = "elevation that the parting reaches behind the crown" }

return styling.preset(..., {
    name = "centre_part",
    edge = "loose",
    schema = schema,
    make = function(head, v, o)
        local style = styling.long(head, o, styling.behind,
            { { 0, 37 }, { 0, 48 }, { 0, 60 }, { v.parting < 70 and 0 or 180, v.parting } })
        local hair = styling.straight(style, o, v)
        return style, hair, { color = "#2c1d17", primary = 0.17, unit = o.scalp:unit() }
    end,
})
