-- Failures that nobody looked at, under every Lua.
local lissom = require "lissom"
local expect = require "expect"

local function count()
    return #lissom.failures()
end

local heard = {}
lissom.listen{ log = function(level, message) heard[#heard + 1] = level .. " " .. message end }
local box = lissom.shapes.box()
local before = count()

-- Taken.
local mesh, message, code = lissom.load("none.obj")
expect.failure("file_not_found", mesh, message, code)
local _ = box:save("no/folder.obj")
if box:save("no/folder.obj") then error("saved") end
assert(not box:save("no/folder.obj"))
assert(not pcall(assert, box:save("no/folder.obj")))
expect.equal(count(), before)

return (function()
    -- Under `lissom run` a dropped failure is one of the script: only other interpreters drop here.
    if rawget(lissom, "render") then return end
    local function save(path) return box:save(path) end
    box:save("no/folder.obj")
    save("no/folder.obj")
    for i = 1, 200 do
        local ok = box:save("no/folder" .. i .. ".obj")
        if ok then error("saved") end
    end
    expect.equal(count(), before + 2)
    expect.truthy(lissom.failures()[1].place:find("dropped_test.lua:27: ", 1, true))
    expect.equal(#heard, 2)
    expect.truthy(heard[1]:find("warning .*dropped_test.lua:27: .*file_write_failed"))
end)()
