--- Long straight hair, nearly without a parting: locks of the front fall before the shoulders, the rest
-- behind them.
--
--     lissom run scripts/presets/long_straight.lua --length 0.33 --inward 0.5
local styling = require "styling"

-- Those of long hair behind the shoulders, but the first, which go before them.
local routes = {
    { { 8, 50, 10 }, { 26, 41, 17 }, { 48, 26, 20 }, { 64, 6, 20 }, { "at", 78, -60, 32 },
        { "at", 68, -115, 50 }, { "at", 58, -180, 76 }, { "at", 52, -320, 92 } },
}
for i = 2, #styling.behind do routes[i] = styling.behind[i] end

-- A mask of strands that would lie on the tops of the shoulders, between both.
local function on_shoulders(scalp, hair)
    local mask, points, unit, at = {}, hair:points(), scalp:unit(), 0
    for s, count in ipairs(hair:point_counts()) do
        local x, y, z = points:get(at + count)
        local tip = scalp:to_metres(x / unit, y / unit, z / unit)
        mask[s] = tip[2] < -0.14 and math.abs(tip[3] + 0.01) < 0.055 and 1 or 0
        at = at + count
    end
    return mask
end

local schema = styling.straight_schema(0.31)
schema.inward = { type = "number", default = 0.2, min = 0, max = 1, help = "how far the ends turn in" }

return styling.preset(..., {
    name = "long_straight",
    edge = "loose",
    schema = schema,
    make = function(head, v, o)
        local style = styling.long(head, o, routes, { { -6, 38 }, { -7, 46 }, { -9, 54 } })
        local hair = styling.straight(style, o, v)
        hair:cull{ mask = styling.over_face(o.scalp, hair) }
        hair:cull{ mask = on_shoulders(o.scalp, hair) }
        if v.inward > 0 then
            hair:roll{ radius = 0.03, start = 0.9, factor = v.inward }
            hair:push_out{ head = style, clearance = 0.002 }
        end
        return style, hair, { color = "#7a5232", primary = 0.3, unit = o.scalp:unit() }
    end,
})
