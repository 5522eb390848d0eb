--- Files and a picture of a mesh before and after a change.
--
--     local before_after = require "before_after"
--     print(before_after.write{ name = "cactus", out = "out", before = rest, after = mesh,
--         region = "movable", handles = { "tip" } })
local lissom = require "lissom"

local before_after = {}

local known = {
    name = "string", out = "string", before = "userdata", after = "userdata", region = "string",
    handles = "table", view = "string", camera = "userdata", size = "table", wire = "boolean",
}

local function check(options)
    for key, value in pairs(options) do
        if not known[key] then
            lissom.error{ message = "unknown option '" .. tostring(key) .. "' of 'write'", level = 3 }
        end
        if type(value) ~= known[key] then
            lissom.error{ level = 3,
                message = "option '" .. key .. "' of 'write': " .. known[key]
                    .. " expected, got " .. type(value) }
        end
    end
    for _, key in ipairs{ "name", "before", "after" } do
        if options[key] == nil then
            lissom.error{ message = "'write' needs the option '" .. key .. "'", level = 3 }
        end
    end
end

--- Writes OUT/NAME.obj and OUT/NAME.ply of `after`, and OUT/NAME.png with both meshes side by side.
-- Options: name; before and after, two meshes; out, the folder (default "out"); region and handles, names of
-- regions of both meshes, drawn blue and purple; view or camera; size, the picture's in pixels (default 1200
-- x 640); wire, to draw the edges. Returns the path of the first file; raises an error if a file cannot be
-- written.
function before_after.write(options)
    check(options)
    local path = (options.out or "out") .. "/" .. options.name
    options.after:save(path .. ".obj")
    options.after:save(path .. ".ply")
    lissom.render{
        meshes = { options.before, options.after }, columns = 2, view = options.view, camera = options.camera,
        region = options.region, handles = options.handles, wire = options.wire,
        size = options.size or { 1200, 640 }, file = path .. ".png",
    }
    return path .. ".obj"
end

return before_after
