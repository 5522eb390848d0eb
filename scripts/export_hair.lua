--- Hair for an engine: a head and a preset in; a folder out, with strands, guides, cards and their pictures,
-- and a shell, in levels of detail, one manifest that names them all, and a sheet of pictures to look at.
--
-- The rig has lengths, root frames, ties, links and capsules for a simulation of the guides.
-- Each level has the error of its silhouette from all sides, as a part of that of the full hair, and the
-- part of the picture's height (screen_size) up to which it shows as much as the finest does in full.
--
--     lissom run scripts/export_hair.lua --head head.obj --preset bob --out out/bob
--     lissom batch scripts/export_hair.lua --over 'heads/*.obj' --sweep 'preset=*' \
--         --out 'out/{name}/{preset}'
local hairdo = require "hairdo"
local lissom = require "lissom"
local styling = require "styling"

local presets = {
    "afro", "bob", "braid", "bun", "buzz", "centre_part", "cornrows", "crop", "crown_braid", "half_up",
    "high_ponytail", "locs", "long_straight", "messy", "mohawk", "pigtails", "pixie", "ponytail", "ringlets",
    "side_part", "slick_back", "spiky", "topknot", "two_braids", "undercut", "waves",
}

local params = hairdo.params{
    name = "hair",
    count = 20000,
    more = {
        preset = { type = "choice", default = "bob", choices = presets,
            help = "a hairstyle of scripts/presets" },
        size = { type = "integer", default = 1200, min = 64, max = 4096, unit = "pixels",
            help = "width and height of the sheet of pictures" },
        color = { type = "string", default = "", help = "of the hair, \"#rrggbb\"; else the preset's" },
        guides = { type = "integer", default = 300, min = 3, help = "strands that an engine simulates" },
        strand_levels = { type = "integer", default = 3, min = 1, max = 8,
            help = "levels of strands, each of half as many as the one before" },
        of = { type = "choice", default = "all", choices = { "all", "groups" },
            help = "levels of all hair, or of each group, which has its part of each count" },
        shell = { type = "integer", default = 2000, min = 20, max = 200000,
            help = "triangles of the shell, the last level" },
        points = { type = "integer", default = 16, min = 2, max = 256, help = "of guided strands" },
        cards = { type = "integer", default = 200, min = 1, max = 100000, help = "of the finest cards" },
        slots = { type = "integer", default = 64, min = 1, max = 256, help = "pictures in an atlas" },
        atlas = { type = "integer", default = 2048, min = 64, max = 8192, unit = "pixels",
            help = "sides of the atlas" },
    },
}

-- ---- Text

local function quoted(text)
    return '"' .. text:gsub('[%c"\\]', function(c) return string.format("\\u%04x", c:byte()) end) .. '"'
end

local function sorted_keys(t)
    local keys = {}
    for key in pairs(t) do keys[#keys + 1] = key end
    table.sort(keys)
    return keys
end

local function json(value, indent)
    indent = indent or ""
    if type(value) == "string" then return quoted(value) end
    if type(value) ~= "table" then return type(value) == "number" and string.format("%.9g", value)
        or tostring(value) end
    local parts, inner = {}, indent .. "  "
    if #value > 0 then
        for i, item in ipairs(value) do parts[i] = inner .. json(item, inner) end
        return "[\n" .. table.concat(parts, ",\n") .. "\n" .. indent .. "]"
    end
    for i, key in ipairs(sorted_keys(value)) do
        parts[i] = inner .. quoted(key) .. ": " .. json(value[key], inner)
    end
    return "{\n" .. table.concat(parts, ",\n") .. "\n" .. indent .. "}"
end

-- ---- Levels

local function path(name) return params.out .. "/" .. name end

-- Each level of strands has half as many as the one before: what covers as much of a picture half as high.
local function strand_levels()
    local levels, points = {}, { 24, 16, 12, 10, 8, 8, 6, 6 }
    for i = 1, params.strand_levels do
        levels[i] = { screen_size = 0.5 ^ (i - 1), points = points[i] }
    end
    return levels
end

local function card_levels()
    local levels = {}
    for i, level in ipairs{ { 1, 16 }, { 0.5, 10 }, { 0.25, 8 } } do
        levels[i] = { count = math.max(1, math.floor(params.cards * level[1] + 0.5)), sections = level[2] }
    end
    return levels
end

-- Its colours as pictures show them; in the file they are linear.
local function for_pictures(mesh)
    local shown = lissom.mesh{ positions = mesh:positions(), faces = mesh:faces() }
    local linear, values = mesh:attribute("color"), {}
    for i = 1, linear:count() do
        for _, c in ipairs{ linear:get(i) } do
            values[#values + 1] = c <= 0.0031308 and 12.92 * c or 1.055 * c ^ (1 / 2.4) - 0.055
        end
    end
    shown:add_attribute{ name = "color", domain = "vertex", width = 3, values = values }
    return shown
end

-- Strands of a head with a skin are bound to its joints.
local function has_skin(mesh)
    for _, attribute in ipairs(mesh:attributes()) do
        if attribute.name == "joints" then return true end
    end
    return false
end

-- Strands of the sheet have the tones that bake_cards gives to cards: darker roots and lighter tips.
local function with_tones(strands, color)
    local profile, base = {}, styling.linear(color)
    for i, tone in ipairs{ 0.72, 1, 1.05, 1.13, 1.18 } do
        profile[i] = { tone * base[1], tone * base[2], tone * base[3] }
    end
    return strands:copy():set_colors{ profile = profile }
end

-- Writers of the files of a level, by kind. Each returns what the manifest says of it beside its measures,
-- and what the sheet shows of it.
local save = {}

function save.strands(level, name, _, color, skinned)
    level.strands:save(path(name .. ".usda"), { head = skinned })
    local count = #level.strands
    return { file = name .. ".usda", strands = count, points = level.strands:stats().points,
        widened = level.widen, skeleton = skinned ~= nil },
        { strands = with_tones(level.strands, color), caption = count .. " strands" }
end

function save.cards(level, name, number, color)
    local atlas = {}
    for _, kind in ipairs{ "color", "flow", "data" } do atlas[kind] = name .. "_" .. kind .. ".png" end
    local size = math.max(64, math.floor(params.atlas / 2 ^ (number - 1)))
    local _, ribbons, cap = lissom.bake_cards{ cards = level.cards, color = color, size = size,
        mesh = path(name .. ".glb"), file = path(atlas.color), flow = path(atlas.flow),
        data = path(atlas.data), strand_tone = 0.12 }
    local stats = level.cards:stats()
    return { file = name .. ".glb", cards = stats.cards, triangles = stats.triangles, slots = stats.slots,
        atlas = atlas, atlas_size = size, covered = stats.covered, off_card = stats.rms },
        { mesh = cap, strands = ribbons,
            caption = stats.cards .. " cards, " .. stats.triangles .. " triangles" }
end

function save.shell(level, name)
    level.mesh:save(path(name .. ".glb"))
    local triangles = level.mesh:face_count()
    return { file = name .. ".glb", triangles = triangles },
        { mesh = for_pictures(level.mesh), caption = triangles .. " triangles, shell" }
end

-- Writes all levels; returns their entries in the manifest and the pictures of the sheet.
local function save_levels(levels, color, skinned)
    local entries, shown, numbers, groups = {}, {}, {}, 0
    for i, level in ipairs(levels) do
        local group = level.group or ""
        if not numbers[group] then
            groups = groups + 1
            numbers[group] = { strands = 0, cards = 0, shell = 0, place = groups }
        end
        local of = numbers[group]
        of[level.kind] = of[level.kind] + 1
        local name = level.kind == "shell" and "shell" or level.kind .. "_" .. of[level.kind]
        if params.of == "groups" then name = "group" .. of.place .. "_" .. name end
        entries[i], shown[i] = save[level.kind](level, name, of[level.kind], color, skinned)
        entries[i].kind, entries[i].group = level.kind, level.group
        entries[i].screen_size, entries[i].silhouette = level.screen_size, level.silhouette
        if level.group then shown[i].caption = level.group .. ": " .. shown[i].caption end
    end
    return entries, shown
end

local head = hairdo.head(params)
local preset = require("presets." .. params.preset)
local style, hair, look = preset.grow(head, {},
    { scalp = hairdo.scalp(head, params), resolution = params.resolution, count = params.count })
local color = params.color ~= "" and params.color or look.color or "#8a6a4a"
local unit = style:scalp():unit()

local manifest = {
    version = 2, generator = "Lissom " .. lissom.version, preset = params.preset, color = color,
    units = { strands = "metres", guides = "metres", cards = "units of the head",
        shell = "units of the head", head_unit = unit },
    up = "y",
}

-- Strands and guides.
hair:set_colors{ color = styling.linear(color) }
local set = hair:guide_set{ count = params.guides, points = params.points }
set:save(path("hair.guides"))
local off = set:error()
manifest.guides = { file = "hair.guides", guides = #set, strands = #hair, points = params.points,
    error_rms = off.rms, error_max = off.max }

-- What holds the guides, for simulations.
local rig = set:dynamics{ head = style }:save(path("rig.json")):rig()
manifest.rig = { file = "rig.json", ties = #rig.ties, links = rig.links, capsules = #rig.capsules,
    capsule_cover = rig.capsule_cover }

-- Levels stand for full hair: strands of a natural width would leave holes. Few short strands stand for it if
-- they are wider still.
local function make_levels(width)
    local made, levels = pcall(hair.levels, hair, { style = style, of = params.of, slots = params.slots,
        strands = strand_levels(), cards = card_levels(), shell = { triangles = params.shell },
        width = width })
    if made then return levels end
    local is_thin = tostring(levels):find("covers no pixel", 1, true)
    if not is_thin or width > 0.01 then error(levels, 0) end
    return make_levels(2 * width)
end

local shown
manifest.levels, shown = save_levels(make_levels(styling.width_for(0.00026, #hair)), color,
    has_skin(head) and head or nil)

print("level                        triangles  screen size  silhouette, worst")
for _, level in ipairs(manifest.levels) do
    print(string.format("%-28s %9s %12.3f %10.1f %%, %4.1f %%", level.file, level.triangles or "-",
        level.screen_size, 100 * level.silhouette.mean, 100 * level.silhouette.worst))
end

-- ---- The sheet: each level from the front and from behind.

local function append_colored(mesh, preview)
    local skin = {}
    for part in hairdo.skin:gmatch("%x%x") do skin[#skin + 1] = tonumber(part, 16) / 255 end
    local colors = {}
    for _ = 1, mesh:face_count() do
        for k = 1, 3 do colors[#colors + 1] = skin[k] end
    end
    local both = lissom.mesh{ positions = mesh:positions(), faces = mesh:faces() }
    both:add_attribute{ name = "color", domain = "face", width = 3, values = colors }
    return preview and both:append(preview) and both or both
end

local function save_sheet()
    local files = {}
    for _, side in ipairs{ "front", "back" } do
        local meshes, strands, captions = {}, {}, {}
        for i, level in ipairs(shown) do
            meshes[i] = append_colored(head, level.mesh)
            strands[i] = level.strands or hair:select{ first = 1 }
            captions[i] = level.caption
        end
        local file = "levels_" .. side .. ".png"
        lissom.render{ meshes = meshes, strands = strands, columns = 3, captions = captions,
            camera = hairdo.camera(style, hair, side), size = { params.size, params.size },
            background = "#c8ccd2",
            hair = { unit = unit, root_tone = 1, tip_tone = 1, clump_tone = 0.08 }, file = path(file) }
        files[#files + 1] = file
    end
    return files
end

if params.pictures then manifest.pictures = save_sheet() end
local file = assert(io.open(path("manifest.json"), "w"))
file:write(json(manifest), "\n")
file:close()
