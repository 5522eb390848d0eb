--- One picture of all operators on strands: a hanging sheet of hair before, and after each.
--
--     lissom run scripts/swatches.lua --out docs/guide
local lissom = require "lissom"
local styling = require "styling"

local params = lissom.params{
    out = { type = "folder", default = "out", help = "folder of operators.png" },
    count = { type = "integer", default = 900, min = 50, help = "strands of each" },
    size = { type = "integer", default = 130, min = 32, help = "pixels of a cell" },
    columns = { type = "integer", default = 10, min = 1, help = "cells in a row" },
}

local length = 0.12

-- A number of chance, 0 to 1, of a strand and a use.
local function chance(s, use)
    local x = math.sin(12.9898 * s + 78.233 * use) * 43758.5453
    return x - math.floor(x)
end

-- Hair that hangs from a narrow strip, a little bowed to the front.
local function sheet()
    local points, counts = {}, {}
    for s = 1, params.count do
        local x, z = 0.07 * (chance(s, 1) - 0.5), 0.012 * (chance(s, 2) - 0.5)
        for k = 0, 31 do
            local a = length * k / 31
            points[#points + 1] = { x * (1 + 0.6 * a), -a, z + 0.03 * math.sin(14 * a) }
        end
        counts[s] = 32
    end
    return lissom.strands{ points = points, counts = counts }
end

-- A strand with kinks, an example of details.
local function kinked()
    local points = {}
    for k = 0, 80 do points[k + 1] = { 0.0016 * (math.floor(k / 3) % 2), -0.0015 * k, 0 } end
    return lissom.strands{ points = points, counts = { #points } }
end

local straight = { { 0, -0.02, 0 }, { 0, -0.06, 0 }, { 0, -0.16, 0 } }
local across = { { -0.06, -0.03, 0.01 }, { 0, -0.03, 0.01 }, { 0.05, -0.03, 0.01 } }

-- Operators with the calls that show them.
local swatches = {
    { "(before)", function() end },
    { "gather", function(h) h:gather{ guides = 9, spread = 0.0008, ramp = 0.04 } end },
    { "clump", function(h) h:clump() end },
    { "twist", function(h)
        h:gather{ guides = 6, spread = 0.003 }:twist{ wavelength = 0.03, ramp = 0.03 }
    end },
    { "pinch", function(h) h:pinch{ guides = 5, place = 0.5, width = 0.2 } end },
    { "curl", function(h) h:guides{ count = 12 }:gather{ spread = 0.001 }:curl{ radius = 0.005,
        wavelength = 0.02, ramp = 0.03, start = 0.01 } end },
    { "wave", function(h) h:guides{ count = 20 }:wave{ radius = 0.004, wavelength = 0.04, start = 0.01,
        ramp = 0.02 } end },
    { "frizz", function(h) h:frizz{ amplitude = 0.002, wavelength = 0.02 } end },
    { "noise", function(h) h:noise{ amplitude = 0.008, across = 0.01, along = 0.04 } end },
    { "detail", function(h) h:guides{ count = 40 }:detail{ from = kinked(), turn = 1 } end },
    { "smooth", function(h) h:frizz{ amplitude = 0.003 }:smooth{ iterations = 40 } end },
    { "straighten", function(h) h:straighten{} end },
    { "rotate", function(h) h:rotate{ axis = { 0, 0, 1 }, angle = 30, shape = 1 } end },
    { "roll", function(h) h:roll{ radius = 0.014, start = 0.4, center = { 0, -0.06, -0.1 } } end },
    { "puff", function(h) h:puff{ amount = 0.03, center = { 0, -0.05, 0 }, shape = 1 } end },
    { "displace", function(h) h:displace{ offset = { 0.03, 0, 0 }, shape = 2 } end },
    { "set_length", function(h) h:set_length{ scale = 0.7, variation = 0.3 } end },
    { "trim", function(h) h:trim{ factor = 0.8, variation = 0.5 } end },
    { "cut", function(h) h:cut{ plane = { point = { 0, -0.08, 0 }, normal = { 0.4, -1, 0 } } } end },
    { "cull", function(h) h:cull{ part = 0.7 } end },
    { "blend", function(h) h:frizz{ amplitude = 0.006 }:blend{ guides = 12 } end },
    { "duplicate", function(h) h:duplicate{ copies = 1, radius = 0.006 } end },
    { "resample", function(h) h:frizz{ amplitude = 0.004 }:resample{ count = 5 } end },
    { "taper", function(h) h:taper{ tip = 0.1 } end },
    { "set_colors", function(h) styling.ombre(h, "dark_brown", "blond") end },
    { "braid", function(h) h:gather{ guides = 1, spread = 0.008, ramp = 0.02 }:braid{ spine = straight,
        across = { 1, 0, 0 }, radius = 0.006, reach = 0.05, length = 0.07, tuft = 0.02 } end },
    { "bun", function(h) h:gather{ guides = 1, spread = 0.006, ramp = 0.02 }:bun{ center = { 0, -0.04, 0.02 },
        direction = { 0, -1, 0.3 }, reach = 0.05, radius = 0.012, tube = 0.013, lift = 0.004 } end },
    { "set_widths", function(h) h:cull{ part = 0.8 }:set_widths{ width = 0.0015 } end },
    { "feed_braid", function(h) h:feed_braid{ spine = across, across = { 0, 1, 0 }, radius = 0.004,
        wide = 0.006, high = 0.004, wavelength = 0.03, reach = 0.03 } end },
}

-- The bar that the sheet hangs from.
local function bar() return lissom.shapes.box{ size = { 0.08, 0.005, 0.016 } } end

local bars, strands, captions = {}, {}, {}
for i, one in ipairs(swatches) do
    local hair = sheet()
    hair:set_colors{ color = styling.linear(styling.colors.light_brown) }
    hair:set_widths{ width = 0.00035 }
    one[2](hair)
    bars[i], strands[i], captions[i] = bar(), hair, one[1]
end
lissom.render{
    meshes = bars, strands = strands, hair = { unit = 1 }, columns = params.columns, captions = captions,
    background = "#e4e6ea",
    camera = lissom.camera{ eye = { 0, -0.06, 0.6 }, target = { 0, -0.064, 0 }, fov = 15 },
    file = params.out .. "/operators.png",
    size = { params.size * params.columns,
        math.floor(1.2 * params.size) * math.ceil(#strands / params.columns) },
}
