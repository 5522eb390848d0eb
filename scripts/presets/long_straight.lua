--- Long straight hair, nearly without a parting: locks of the front fall before the shoulders, the rest
-- behind them.
--
--     lissom run scripts/presets/long_straight.lua --length 0.33 --inward 0.5
local styling = require "styling"

local before = {
    { { 8, 50, 10 }, { 26, 41, 17 }, { 48, 26, 20 }, { 64, 6, 20 }, { "at", 80, -60, 26 },
        { "at", 73, -115, 44 }, { "at", 66, -180, 70 }, { "at", 60, -340, 80 } },
    { { 24, 72, 10 }, { 62, 50, 18 }, { 78, 24, 20 }, { 84, 4, 20 }, { "at", 90, -60, 4 },
        { "at", 86, -115, 30 }, { "at", 81, -180, 62 }, { "at", 74, -340, 74 } },
}
-- Those of long hair behind the shoulders, but the first.
local behind = {}
for i = 2, #styling.behind do behind[i - 1] = styling.behind[i] end

local schema = styling.straight_schema(0.31)
schema.inward = { type = "number", default = 0.2, min = 0, max = 1, help = "how far the ends turn in" }

return styling.preset(..., {
    name = "long_straight",
    edge = "loose",
    schema = schema,
    make = function(head, v, o)
        local parting = { { -6, 38 }, { -7, 46 }, { -9, 54 } }
        -- Two fields: in one, hair between those before and behind would lie on the tops of the shoulders.
        local function part(routes, share, forwards)
            local style = styling.long(head, o, routes, parting)
            local rooted = styling.by_angles(o.scalp, function(_, _, p)
                local front = styling.smooth(0.014, 0.026, p[3])
                return forwards and front or 1 - front
            end)
            return style, styling.straight(style, o, v, { density = rooted,
                count = math.floor(share * o.count), seed = forwards and v.seed + 101 or v.seed })
        end
        local style, hair = part(behind, 0.65, false)
        local front_style, front = part(before, 0.35, true)
        front:cull{ mask = styling.over_face(o.scalp, front) }
        if v.inward > 0 then
            for lock_style, locks in pairs{ [style] = hair, [front_style] = front } do
                locks:roll{ radius = 0.03, start = 0.9, factor = v.inward }
                locks:push_out{ head = lock_style, clearance = 0.002 }
            end
        end
        return style, hair:append(front), { color = "#7a5232", primary = 0.17, unit = o.scalp:unit() }
    end,
})
