-- Grows a preset of hair on a head and shows it, for contact sheets of heads, presets and lengths.
--
--     lissom run examples/batch/heads.lua --head anna.obj --preset bob --out anna.png
--     lissom batch examples/batch/heads.lua --over 'heads/*.obj' --sweep preset=bob,waves \
--         --sweep length=0.8,1.2 --out 'out/{name}_{preset}_{length}.png'
local hairdo = require "hairdo"
local lissom = require "lissom"
local styling = require "styling"

local params = lissom.params{
    head = { type = "file", default = "", help = "a bald head, instead of the generated one" },
    preset = { type = "choice", default = "waves",
        choices = { "bob", "half_up", "high_ponytail", "messy", "pigtails", "ringlets", "slick_back",
            "two_braids", "waves" },
        help = "the style" },
    length = { type = "number", default = 1, min = 0.8, max = 1.2, help = "times that of the preset" },
    count = { type = "integer", default = 8000, min = 100, max = 200000, help = "strands" },
    size = { type = "integer", default = 320, min = 64, max = 2048, unit = "pixels", help = "its size" },
    out = { type = "file", default = "hair.png", help = "the picture" },
}

local head = params.head == "" and lissom.shapes.head{ vertices = 12000 } or lissom.load(params.head)
local preset = require("presets." .. params.preset)
local length = params.length * preset.schema.length.default
local style, hair, look = preset.grow(head, { length = length }, { count = params.count })
hair:set_colors{ color = styling.linear(look.color or "#6b4a2f") }
if lissom.render then
    lissom.render{
        mesh = head, strands = hair, file = params.out, size = { params.size, params.size },
        camera = hairdo.camera(style, hair, "three-quarter"),
    }
end
