--- Long straight hair over the shoulders, nearly without a parting.
--
--     lissom run scripts/presets/long_straight.lua --length 0.33 --inward 0.5
local styling = require "styling"

local schema = styling.straight_schema(0.31)
schema.inward = { type = "number", default = 0.2, min = 0, max = 1, help = "how far the ends turn in" }

return styling.preset(..., {
    name = "long_straight",
    schema = schema,
    make = function(head, v, o)
        local style = styling.long(head, o, styling.over_shoulders, { { -6, 38 }, { -7, 46 }, { -9, 54 } })
        local hair = styling.straight(style, o, v)
        hair:cull{ mask = styling.over_face(o.scalp, hair) }
        if v.inward > 0 then
            hair:roll{ radius = 0.03, start = 0.9, factor = v.inward }
            hair:push_out{ head = style, clearance = 0.002 }
        end
        return style, hair, { color = "#7a5232", primary = 0.3, unit = o.scalp:unit() }
    end,
})
