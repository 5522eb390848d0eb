-- Draws the picture of one script for the gallery: runs it, and keeps of its pictures the one that is wanted.
--
--     SITE_SCRIPT=FILE SITE_PICTURE=FILE.png lissom run viewer/web/site/picture.lua [its options]
--
-- Its own params are those of the script. SITE_NAME is the name of the wanted picture without its ending, by
-- default the first; SITE_SAVED is a mesh that the script saves, which is drawn if it draws nothing itself.
local lissom = require "lissom"

local wanted, file = os.getenv("SITE_NAME"), os.getenv("SITE_PICTURE")
local longest = { 640, 480 }
local render, drawn = lissom.render, false

local function name_of(options) return tostring(options.file):match("([^/\\]+)%.png$") end

-- The size within the card, of the same shape; cells that a view frames fill it.
local function fitting(options)
    local size = options.size
    if (options.columns or 0) > 0 and not options.camera then return longest end
    if type(size) == "number" then size = { size, size } end
    local width, height = size and size[1] or longest[1], size and size[2] or longest[2]
    local scale = math.min(longest[1] / width, longest[2] / height)
    return { math.floor(width * scale + 0.5), math.floor(height * scale + 0.5) }
end

-- Text cannot be read at the size of a card.
local function for_card(options)
    local own = {}
    for key, value in pairs(options) do own[key] = value end
    own.file, own.size, own.background, own.supersample = file, fitting(options), "transparent", 2
    own.captions = nil
    if own.scalars then own.legend = false end
    if own.columns == 4 and not own.camera and #own.meshes % 4 == 0 then own.columns = 2 end
    return own
end

function lissom.render(options)
    if drawn or wanted and name_of(options) ~= wanted then return options.file end
    render(for_card(options))
    drawn = true
    return options.file
end

local function drawable(kind, ...)
    for i = 1, select("#", ...) do
        local value = select(i, ...)
        if type(value) == "userdata" and getmetatable(value) == kind then return value end
        if type(value) == "table" and drawable(kind, table.unpack(value)) then return value end
    end
end

-- A script without a picture of its own shows its results or saved files, as in the playground.
local function draw_results(...)
    if drawn then return end
    local saved, style = os.getenv("SITE_SAVED"), drawable("lissom.Hairstyle", ...)
    local mesh, strands = drawable("lissom.Mesh", ...), drawable("lissom.Strands", ...)
    if saved then mesh = lissom.load(saved) end
    if strands and style then mesh = style:head() end
    if mesh or strands then
        lissom.render{ mesh = mesh, strands = strands, file = (wanted or "result") .. ".png" }
    end
end

draw_results(assert(loadfile(os.getenv("SITE_SCRIPT")))())
if not drawn then lissom.error{ message = "the script has not drawn " .. (wanted or "a picture") } end
