--- An undercut: hair on top is combed back over shaved sides that fade out downwards.
--
--     lissom run scripts/presets/undercut.lua --top 0.12 --sides 0.003
local lissom = require "lissom"
local styling = require "styling"

local routes = {
    { { 0, 37, 3 }, { 0, 46, 20 }, { 0, 62, 22 }, { 0, 82, 18 }, { 180, 68, 12 }, { 180, 40, 3 },
        { 180, 20, 2 }, stop = 0.02 },
    { { 24, 38, 3 }, { 26, 46, 18 }, { 32, 58, 20 }, { 60, 72, 17 }, { 140, 70, 11 }, { 158, 40, 3 },
        { 162, 20, 2 }, stop = 0.02 },
    { { 42, 38, 3 }, { 50, 44, 13 }, { 66, 50, 13 }, { 100, 54, 12 }, { 132, 50, 7 }, { 142, 34, 3 },
        { 147, 16, 2 }, stop = 0.02 },
}

return styling.preset(..., {
    name = "undercut",
    edge = "short",
    schema = {
        top = { type = "number", default = 0.1, min = 0.04, max = 0.14, unit = "metres",
            help = "length of the hair on top" },
        sides = { type = "number", default = 0.004, min = 0.001, max = 0.015, unit = "metres",
            help = "length of the shaved hair below it" },
        fade = { type = "number", default = 0.6, min = 0, max = 1,
            help = "part by which shaved hair is shorter and thinner at the hairline" },
        line = { type = "number", default = 46, min = 32, max = 60, unit = "degrees",
            help = "elevation of the line between them at the sides" },
    },
    make = function(head, v, o)
        local scalp = o.scalp
        local function on_top(azimuth, elevation)
            local line = 20 + (v.line - 20) * styling.smooth(40, 70, math.abs(azimuth))
            return styling.smooth(line - 1.5, line + 1.5, elevation)
        end
        local function shaved(azimuth, elevation)
            return (1 - on_top(azimuth, elevation)) * styling.fade(azimuth, elevation, 0.8 * v.fade)
        end
        local function faded(_, elevation)
            return v.sides * (1 - v.fade * (1 - styling.smooth(-30, v.line, elevation)))
        end
        -- Hair from behind the crown is shorter, so that it ends on the head and in no ledge over the line.
        local function top_length(azimuth, elevation)
            local behind = styling.smooth(75, 135, math.abs(azimuth))
            return v.top * (1 - 0.85 * behind * (1 - styling.smooth(66, 92, elevation)))
        end
        local _, hair = styling.stubble(head, o, { part = 1, seed = v.seed,
            length = styling.by_angles(scalp, faded), density = styling.by_angles(scalp, shaved) })
        styling.thin_out(hair):set_colors{ color = { 0.06, 0.036, 0.02 } }
        local style = lissom.hairstyle(head, { scalp = scalp, gravity = 0, resolution = o.resolution })
        styling.streams(style, routes)
        local top = style:grow{ count = math.floor(0.6 * o.count), seed = v.seed,
            length = styling.by_angles(scalp, top_length), density = styling.by_angles(scalp, on_top),
            layer = 0.008, clearance = 0.002, lift = 0.5, variation = 0.2 }
        top:resample{ count = 24 }:smooth{ iterations = 3 }
        top:clump{ clumps = 350, strength = 0.55 }:clump{ clumps = 1500, strength = 0.4, seed = 2 }
        styling.finish(top, 0.00026, 0.002, o.count):push_out{ head = style, clearance = 0.0015 }
        return style, hair:append(top:set_colors{ color = { 0.1, 0.055, 0.028 } }), { unit = scalp:unit() }
    end,
})
