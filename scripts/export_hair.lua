--- Hair for an engine: a head and a preset in; a folder out, with strands, guides, cards and their pictures,
-- and a shell, in levels of detail, one manifest that names them all, and a sheet of pictures to look at.
--
-- Each level has the error of its silhouette from all sides, as a part of that of the full hair, and the
-- part of the picture's height (screen_size) up to which it shows as much as the finest does in full.
--
--     lissom run scripts/export_hair.lua --head head.obj --preset bob --out out/bob
--     lissom batch scripts/export_hair.lua --over 'heads/*.obj' --out 'out/{name}' -- --preset bob
local hairdo = require "hairdo"
local lissom = require "lissom"
local styling = require "styling"

local params = hairdo.params{
    name = "hair",
    count = 20000,
    more = {
        preset = { type = "string", default = "bob", help = "a hairstyle of scripts/presets" },
        color = { type = "string", default = "", help = "of the hair, \"#rrggbb\"; else the preset's" },
        guides = { type = "integer", default = 300, min = 3, help = "strands that an engine simulates" },
        strand_levels = { type = "integer", default = 3, min = 1, max = 8,
            help = "levels of strands, each of half as many as the one before" },
        shell = { type = "integer", default = 2000, min = 20, max = 200000,
            help = "triangles of the shell, the last level" },
        points = { type = "integer", default = 16, min = 2, max = 256, help = "of guided strands" },
        cards = { type = "integer", default = 200, min = 1, max = 100000, help = "of the finest cards" },
        slots = { type = "integer", default = 32, min = 1, max = 256, help = "pictures in an atlas" },
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

-- The hair as so large a part of its strands, each with so many points; the second result is how much wider
-- an engine draws them to cover as much.
local function strand_level(hair, part, points)
    local count = math.max(1, math.floor(#hair * part + 0.5))
    local level = hair:select{ first = count }
    level:resample{ count = points }
    return level, #hair / count
end

-- Strands that cover so much of a picture that is half as high are half as many.
local function save_strands(level, widen, number, error)
    local name = string.format("strands_%d.usda", number)
    level:save(path(name))
    return { kind = "strands", file = name, strands = #level, points = level:stats().points,
        width_factor = widen, screen_size = 1 / widen, silhouette = error }
end

-- The part of the height of a picture of 1080 lines in which hair of this height is off by a pixel at most.
local function screen_size(hair, off)
    local bounds = hair:bounds()
    return math.min(1, (bounds.max[2] - bounds.min[2]) / (1080 * math.max(off, 1e-6)))
end

local function save_cards(strands, style, count, sections, number, color)
    local cards = strands:cards{ count = count, style = style, sections = sections, slots = params.slots }
    local names = {}
    for _, kind in ipairs{ "color", "flow", "data" } do
        names[kind] = string.format("cards_%d_%s.png", number, kind)
    end
    local mesh = string.format("cards_%d.glb", number)
    local size = math.max(64, math.floor(params.atlas / 2 ^ (number - 1)))
    local preview = lissom.bake_cards{ cards = cards, color = color, size = size, mesh = path(mesh),
        file = path(names.color), flow = path(names.flow), data = path(names.data), strand_tone = 0.12 }
    local stats = cards:stats()
    return { kind = "cards", file = mesh, cards = stats.cards, triangles = stats.triangles,
        slots = stats.slots, atlas = names, atlas_size = size, covered = stats.covered,
        off_card = stats.rms, screen_size = screen_size(strands, stats.rms),
        silhouette = strands:silhouette_error{ cards = cards } }, preview
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

local SHELL_CELL = 0.005
local function save_shell(strands, style, unit)
    local mesh = strands:shell{ style = style, triangles = params.shell, cell = SHELL_CELL }
    mesh:save(path("shell.glb"))
    return { kind = "shell", file = "shell.glb", triangles = mesh:face_count(),
        screen_size = screen_size(strands, SHELL_CELL),
        silhouette = strands:silhouette_error{ mesh = mesh, unit = unit } }, mesh
end

local head = hairdo.head(params)
local found, preset = pcall(require, "presets." .. params.preset)
if not found then
    local is_unknown = tostring(preset):find("presets." .. params.preset .. "' not found", 1, true)
    local message = "there is no preset '" .. params.preset .. "'; scripts/presets has the names"
    error(is_unknown and message or preset, 0)
end
local style, hair, look = preset.grow(head, {},
    { scalp = hairdo.scalp(head, params), resolution = params.resolution, count = params.count })
local color = params.color ~= "" and params.color or look.color or "#8a6a4a"
local unit = style:scalp():unit()

local manifest = {
    version = 1, generator = "Lissom " .. lissom.version, preset = params.preset, color = color,
    units = { strands = "metres", guides = "metres", cards = "units of the head",
        shell = "units of the head", head_unit = unit },
    up = "y", levels = {},
}

-- Strands and guides.
hair:set_colors{ color = styling.linear(color) }
-- Levels after the first stand for full hair: strands of a natural width would leave holes in them.
local full = styling.set_width(hair:copy(), 0.00026)
local shown, POINTS = {}, { 24, 16, 12, 10, 8, 8, 6, 6 }
for number = 1, params.strand_levels do
    local part = 0.5 ^ (number - 1)
    local strands, widen = strand_level(hair, part, POINTS[number])
    local error = full:silhouette_error{ strands = strand_level(full, part, POINTS[number]), widen = widen }
    manifest.levels[number] = save_strands(strands, widen, number, error)
    shown[number] = { strands = strands, caption = #strands .. " strands" }
end
local set = hair:guide_set{ count = params.guides, points = params.points }
set:save(path("hair.guides"))
local off = set:error()
manifest.guides = { file = "hair.guides", guides = #set, strands = #hair, points = params.points,
    error_rms = off.rms, error_max = off.max }

for number, level in ipairs{ { 1, 12 }, { 0.5, 8 }, { 0.25, 6 } } do
    local count = math.max(1, math.floor(params.cards * level[1] + 0.5))
    local entry, preview = save_cards(full, style, count, level[2], number, color)
    manifest.levels[#manifest.levels + 1] = entry
    shown[#shown + 1] = { mesh = preview,
        caption = entry.cards .. " cards, " .. entry.triangles .. " triangles" }
end

local shell, shell_mesh = save_shell(full, style, unit)
manifest.levels[#manifest.levels + 1] = shell
shown[#shown + 1] = { mesh = for_pictures(shell_mesh), caption = shell.triangles .. " triangles, shell" }

print("level                        triangles  screen size  silhouette, worst")
for _, level in ipairs(manifest.levels) do
    print(string.format("%-28s %9s %12.3f %10.1f %%, %4.1f %%", level.file, level.triangles or "-",
        level.screen_size, 100 * level.silhouette.mean, 100 * level.silhouette.worst))
end

-- ---- The sheet: each level from the front and from behind.

local function append_colored(mesh, preview)
    local skin = { 0.79, 0.58, 0.48 }
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
        lissom.render{ meshes = meshes, strands = strands, columns = 3, captions = captions, view = side,
            size = { params.size, params.size }, hair = { unit = unit }, file = path(file) }
        files[#files + 1] = file
    end
    return files
end

if params.pictures then manifest.pictures = save_sheet() end
local file = assert(io.open(path("manifest.json"), "w"))
file:write(json(manifest), "\n")
file:close()
