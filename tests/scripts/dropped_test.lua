-- Failures that nobody looked at, under every Lua.
local lissom = require "lissom"

local function count()
    return #lissom.failures()
end

local box = lissom.shapes.box()

test("what is looked at, or ignored on purpose, is not dropped", function()
    local before = count()
    expect.failure("file_not_found", lissom.load("none.obj"))
    local _ = box:save("no/folder.obj")
    if box:save("no/folder.obj") then error("saved") end
    assert(not box:save("no/folder.obj"))
    assert(not pcall(assert, box:save("no/folder.obj")))
    expect.equal(count(), before)
end)

-- Under `lissom test` a test fails that drops a failure: only other interpreters drop here.
if not rawget(lissom, "render") then
    test("what is dropped is told once with its line", function()
        local heard = {}
        lissom.listen{ log = function(level, message) heard[#heard + 1] = level .. " " .. message end }
        local before = count()
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
    end)
end
