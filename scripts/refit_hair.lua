--- A style of hair that another program or a scan made: a file of strands and a head in; out comes the style,
-- to be edited like one's own, hair grown from it, and pictures of the given hair beside the grown one.
--
--     lissom run scripts/refit_hair.lua --hair scan.ply --head head.obj --out out/refit
local hairdo = require "hairdo"
local lissom = require "lissom"
local refit = require "refit"

local params = hairdo.params{
    name = "refit",
    count = 0,
    more = {
        hair = { type = "file", default = "", help = "strands: usda, ply, glb, hair, data, tfx; else a bob" },
        guides = { type = "integer", default = 150, min = 3, max = 2000, help = "streams of the style" },
        place = { type = "boolean", default = true,
            help = "finds the unit and place of the strands; no: they lie on the head, in metres" },
        detail = { type = "boolean", default = false, help = "clumps, noise and tapered tips on top" },
        seed = { type = "integer", default = 1, min = 1, help = "of the roots of grown hair" },
    },
}

local head = hairdo.head(params)
local scalp = hairdo.scalp(head, params)

-- For a run without a file: the hair of a preset, in centimetres and beside the head.
local function example()
    local _, hair = require("presets.bob").grow(head, {}, { scalp = scalp, count = 4000,
        resolution = params.resolution })
    return hair:transform{ scale = 100 }:transform{ translate = { 30, 0, 0 } }
end

local strands = params.hair == "" and example() or lissom.load_strands(params.hair)
local made = refit.style(strands, head, { scalp = scalp, guides = params.guides, place = params.place,
    seed = params.seed, resolution = params.resolution, count = params.count > 0 and params.count or nil })
local motion = made.motion
print(string.format("placed: scaled by %.5g, turned by %g degrees, %s up; roots %.1f mm off the head",
    motion.scale, motion.turn, motion.up, 1000 * (made.height or 0)))
print(string.format("%d guides: directions are off by %.1f degrees, lengths by %.1f %%",
    #made.guides:guides(), made.angle, 100 * made.length))
if made.curl then
    print(string.format("curls: radius %.1f mm, wavelength %.0f mm, hand %s, on %.0f %% of the strands",
        1000 * made.curl.radius, 1000 * made.curl.wavelength, made.curl.hand, 100 * made.curl.share))
end

local look = { unit = made.style:scalp():unit() }
for name, hair in pairs{ given = strands, grown = made.hair } do
    hair:set_widths{ width = 0.0005 * math.sqrt(1000 / math.max(#hair, 200)) }
    if params.pictures then
        lissom.render{ meshes = { head }, color = "clay", strands = hair, hair = look, background = "#c8ccd2",
            camera = hairdo.camera(made.style, strands, "three-quarter"), size = { params.size, params.size },
            file = params.out .. "/" .. params.name .. "_" .. name .. ".png" }
    end
end
local files = {}
for _, key in ipairs{ "out", "name", "format", "size", "detail", "pictures" } do files[key] = params[key] end
hairdo.finish(made.style, made.hair, files, nil, look)
