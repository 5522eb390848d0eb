-- Draws the picture of a script as the page shows it: of the page's size, without text.
--
--     WEB_SCRIPT=FILE WEB_PICTURE=FILE.png WEB_SIZE=640x480 \
--         lissom run tests/web/native_picture.lua [its options]
--
-- WEB_NAME is the name of the wanted picture without its ending, by default the first. A script that draws
-- none shows the mesh that it returns.
local lissom = require "lissom"

local wanted = os.getenv("WEB_NAME")
local width, height = os.getenv("WEB_SIZE"):match("(%d+)x(%d+)")
local render, drawn = lissom.render, false

function lissom.render(options)
    local name = tostring(options.file or "picture"):match("([^/]+)$"):gsub("%.png$", "")
    if drawn or wanted and name ~= wanted then return options.file end
    local own = {}
    for key, value in pairs(options) do own[key] = value end
    own.file, own.size = os.getenv("WEB_PICTURE"), { tonumber(width), tonumber(height) }
    own.background, own.supersample, own.captions = "white", 2, nil
    if own.scalars then own.legend = false end
    render(own)
    drawn = true
    return options.file
end

local result = assert(loadfile(os.getenv("WEB_SCRIPT")))()
if not drawn and not wanted then lissom.render{ mesh = result } end
if not drawn then lissom.error{ message = "the script has not drawn " .. (wanted or "a picture") } end
