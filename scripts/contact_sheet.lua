--- One picture of all presets of hairstyles on the generated head.
--
--     lissom run scripts/contact_sheet.lua --out examples/hair
local hairdo = require "hairdo"
local lissom = require "lissom"
local styling = require "styling"

-- Each preset with the turn of its head, degrees from the front, and its colour, else the preset's own.
local presets = {
    { "bob", 35 }, { "pixie", 35 }, { "centre_part", 25, "dark_brown" }, { "side_part", 35, "blond" },
    { "long_straight", 215, "black" }, { "waves", 35, "light_brown" }, { "ringlets", 35, "red" },
    { "afro", 35 }, { "locs", 35 }, { "messy", 35, "auburn" }, { "spiky", 35 }, { "crop", 35 },
    { "buzz", 35 }, { "undercut", 35 }, { "mohawk", 35 }, { "slick_back", 60, "black" },
    { "ponytail", 120 }, { "high_ponytail", 110, "blond" }, { "pigtails", 25, "light_brown" },
    { "half_up", 130, "red" }, { "braid", 150 }, { "two_braids", 30 }, { "crown_braid", 40, "blond" },
    { "cornrows", 130, "black" }, { "bun", 115 }, { "topknot", 60, "dark_brown" },
}

local params = lissom.params{
    out = { type = "folder", default = "out", help = "folder of presets.png" },
    count = { type = "integer", default = 5000, min = 100, help = "strands of each" },
    size = { type = "integer", default = 120, min = 32, help = "pixels of a cell" },
    columns = { type = "integer", default = 7, min = 1, help = "cells in a row" },
    only = { type = "string", default = "", help = "a preset alone" },
}

-- Turns a head and its hair, so that one camera in front sees all from their sides.
local function turned(style, hair, turn)
    local scalp = style:scalp()
    local center, unit, up = scalp:center(), scalp:unit(), scalp:up()
    local about = { center[1] * unit, center[2] * unit, center[3] * unit }
    local head = style:head():copy():transform{ rotate = { axis = up, angle = -turn, about = center } }
    hair:transform{ rotate = { axis = up, angle = -turn, about = about } }
    return head
end

local heads, strands, captions, camera = {}, {}, {}, nil
for _, one in ipairs(presets) do
    local name, turn, color = one[1], one[2], one[3]
    if params.only == "" or params.only == name then
        local head = lissom.shapes.head{ vertices = 12000 }
        local style, hair, look = require("presets." .. name).grow(head, {}, { count = params.count })
        -- Hair of several colours keeps them.
        local shown = styling.colors[color] or look.color
        if shown then hair:set_colors{ color = styling.linear(shown) } end
        heads[#heads + 1], strands[#strands + 1] = turned(style, hair, turn), hair
        captions[#captions + 1] = (name:gsub("_", " "))
        if not camera then
            local scalp, eye = style:scalp(), {}
            local target, front, up = scalp:from_metres(0, -0.045, 0), scalp:front(), scalp:up()
            for k = 1, 3 do eye[k] = target[k] + (1.2 * front[k] + 0.1 * up[k]) / scalp:unit() end
            camera = lissom.camera{ eye = eye, target = target, up = up, fov = 21.5 }
        end
    end
end
local rows = math.ceil(#heads / params.columns)
lissom.render{
    meshes = heads, color = hairdo.skin, strands = strands, columns = math.min(params.columns, #heads),
    camera = camera, captions = captions, background = "#c8ccd2", supersample = 2,
    file = params.out .. "/presets.png",
    size = { params.size * math.min(params.columns, #heads), math.floor(1.15 * params.size) * rows },
}
