--- Cornrows: narrow braids along the scalp from the hairline to the nape.
--
--     lissom run scripts/presets/cornrows.lua --rows 9 --tails 0.16
local lissom = require "lissom"
local styling = require "styling"
local tails = require "tails"

return styling.preset(..., {
    name = "cornrows",
    schema = {
        rows = { type = "integer", default = 13, min = 5, max = 17, help = "number of braids" },
        tails = { type = "number", default = 0.108, min = 0.02, max = 0.25, unit = "metres",
            help = "length of the braids below the nape" },
        gap = { type = "number", default = 0.3, min = 0, max = 0.5,
            help = "part of the scalp between them" },
        thickness = { type = "number", default = 0.82, min = 0.6, max = 1.3,
            help = "of a braid as a part of the usual" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local style = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = o.resolution })
        styling.radial(style, 60)
        local hair = style:grow{ count = math.floor(1.3 * o.count), seed = v.seed, length = 0.004, layer = 0,
            clearance = 0.001, segment = 0.2, lift = 0.5 }
        local pitch, unit, braids = 149.5 / v.rows, scalp:unit(), nil
        local size = v.thickness * pitch / 11.5
        local function across(x, y, z)
            return tails.across(scalp:to_metres(x / unit, y / unit, z / unit))
        end
        for row = 1, v.rows do
            local middle = (row - (v.rows + 1) / 2) * pitch
            local one = hair:select{ where = function(_, x, y, z)
                return math.abs(across(x, y, z) - middle) < 0.5 * (1 - v.gap) * pitch
            end }
            if #one > 0 then
                one:feed_braid{ spine = tails.row(scalp, middle, v.tails), scalp = scalp,
                    across = scalp:left(), radius = 0.0031 * size, wide = 0.0042 * size,
                    high = 0.0019 * size, wavelength = 0.021 * size, blend = 0.009, min_run = 0.03,
                    max_run = 0.06, tail = 0.35, begin_size = 0.4, end_size = 0.55, step = 0.0019,
                    seed = v.seed, drop_others = true }
            end
            braids = braids and braids:append(one) or one
        end
        braids:push_out{ head = style, clearance = 0.0012, ramp = 0.004 }
        braids:frizz{ amplitude = 0.00012, wavelength = 0.008, flyaways = 0 }
        styling.thin_out(styling.set_width(braids, 0.00022))
        return style, braids, { color = "#2a1c16", primary = 0.12, scalp_tint = 0.12,
            unit = unit }
    end,
})
