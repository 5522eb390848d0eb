--- A ponytail: hair is gathered at a tie and falls in a tail.
--
--     lissom run scripts/presets/ponytail.lua --height 50 --length 0.34 --tightness 0.8
local hairdo = require "hairdo"
local ponytails = require "ponytails"
local styling = require "styling"

local schema = {}
for name, parameter in pairs(ponytails.schema) do schema[name] = parameter end

return styling.preset(..., {
    name = "ponytail",
    schema = schema,
    make = function(head, v, o)
        local style, hair, tie = ponytails.grow(head, v,
            { scalp = o.scalp, resolution = o.resolution }, { count = o.count })
        hairdo.cull_missed(hair, o.scalp):smooth{ iterations = 5 }
        styling.tail_ends(hair, v.seed, "ponytail")
        hair:clump{ clumps = 2500, strength = 0.3 }
        styling.finish(hair, 0.00024, 0.0014):push_out{ head = style, clearance = 0.001 }
        return style, hair, { color = "#6b4a2f", unit = o.scalp:unit() }, { hairdo.ring(o.scalp, tie) }
    end,
})
