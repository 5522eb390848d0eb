-- Compares a result with that of an earlier run: a job of this script fails if a model comes out otherwise.
--
--     lissom batch examples/batch/regression.lua --over 'props/*.obj' --out 'out/{name}.json' \
--         --set before=last_week
--
-- Without `before`, or for a model that it does not know, the result is only written.
local lissom = require "lissom"

local params = lissom.params{
    mesh = { type = "file", help = "the model" },
    angle = { type = "number", default = 25, min = -120, max = 120, unit = "degrees",
        help = "turn of its upper end" },
    before = { type = "string", default = "", help = "folder with the results of an earlier run" },
    tolerance = { type = "number", default = 1e-9, min = 0,
        help = "difference of volume or area that is none, as a part of it" },
    out = { type = "file", default = "result.json", help = "the result" },
}

local function result_of(mesh)
    return { hash = mesh:hash(), vertices = mesh:vertex_count(), area = mesh:area(), volume = mesh:volume() }
end

local function json(result)
    return string.format('{"hash": "%s", "vertices": %d, "area": %.17g, "volume": %.17g}\n',
        result.hash, result.vertices, result.area, result.volume)
end

-- The result in a file, or nil if there is none.
local function read(path)
    local file = io.open(path)
    if not file then return nil end
    local text = file:read("a")
    file:close()
    local function number(name) return tonumber(text:match('"' .. name .. '": ([^,}]+)')) end
    return { hash = text:match('"hash": "([^"]+)"'), vertices = number("vertices"), area = number("area"),
        volume = number("volume") }
end

local function compare(now, before)
    if now.hash == before.hash then return end
    for _, name in ipairs{ "vertices", "area", "volume" } do
        local difference = math.abs(now[name] - before[name])
        if difference > params.tolerance * math.max(math.abs(before[name]), 1e-300) then
            local text = "%s: %s was %.9g and is %.9g"
            lissom.error{ message = text:format(params.mesh, name, before[name], now[name]) }
        end
    end
end

local mesh = lissom.load(params.mesh)
lissom.deform(mesh, {
    pin = mesh:region{ fraction = { max = { nil, 0.15, nil } } },
    handles = { { region = mesh:region{ fraction = { min = { nil, 0.85, nil } } },
        rotate = { axis = "z", angle = params.angle } } },
})
local now = result_of(mesh)
local before = params.before ~= "" and read(params.before .. "/" .. params.out:match("[^/]+$"))
if before then compare(now, before) end
local file = assert(io.open(params.out, "w"))
file:write(json(now))
file:close()
