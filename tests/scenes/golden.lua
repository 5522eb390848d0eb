-- What a hand has drawn in the window with each tool (golden/record.sh makes it again): its events and its
-- journal come to one hash here, too.
local lissom = require "lissom"

local folder = package.searchpath("golden.cactus", package.path):match("^(.*/)")

local function text_of(path)
    local file = assert(io.open(path))
    local text = file:read("a")
    file:close()
    return text
end

-- Whether this processor lacks fused multiply-add, with which the hashes were made.
local function rounds_twice()
    local file = io.open("/proc/cpuinfo")
    local text = file and file:read("a") or ""
    if file then file:close() end
    return text ~= "" and not (text:find("%f[%w]fma%f[%W]") and text:find("%f[%w]avx2%f[%W]"))
end

-- Where numbers are rounded otherwise, by the build or by the processor, the events are repeated and their
-- end is compared with that of the calls.
local other_rounding = os.getenv("LISSOM_OTHER_ROUNDING") or rounds_twice()

-- Hair comes from large systems, which each way to solve them rounds otherwise.
local hair = { ponytail = true, parting = true }

local function replayed(path, name)
    if not (other_rounding or hair[name]) then return lissom.replay(path) end
    local text = text_of(path):gsub('hash = "%x+"', "hash = nil"):gsub('(%l+) = "%x+",\n', "%1 = nil,\n")
    local scene = dofile(folder .. text:match('open = { "(.-)" }'))
    local found = { replay = function(recorded) return lissom.replay(recorded, { scene = scene }) end }
    return assert(load(text, "=events", "t", { require = function() return found end }))()
end

for _, name in ipairs{ "select", "deform", "cut", "merge", "transform", "measure", "smooth", "ponytail",
    "parting", "line" } do
    test("a hand with the tool " .. name .. " comes to the scene that it saw", function()
        local scene = replayed(folder .. name .. ".events.lua", name)
        local text = text_of(folder .. name .. ".calls.lua")
        local wanted = (other_rounding or hair[name]) and scene:hash() or text:match('hash%(%) == "(%x+)"')
        expect.equal(scene:hash(), wanted)
        -- A journal names its model as from its own folder, and ends with a check of the hash.
        local here = { dofile = function(path) return dofile(folder .. path) end }
        setmetatable(here, { __index = _G })
        text = text:gsub('(hash%(%) ==) "%x+"', '%1 "' .. wanted .. '"')
        expect.equal(assert(load(text, "=" .. name, "t", here))():hash(), wanted)
    end)
end
