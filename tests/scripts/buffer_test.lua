local lissom = require "lissom"

local function add_tags(grid)
    return grid:add_attribute{ name = "tag", domain = "face", type = "uint8", values = { 1, 2, 3, 4 } }
end

test("positions without a copy: both ways, at once", function()
    local box = lissom.shapes.box()
    local p = box:positions()
    expect.equal(#p, 24)
    expect.equal(p:count(), 8)
    expect.equal(p:width(), 3)
    p[1] = 7
    expect.equal((box:position(1)), 7)
    box:set_position(1, 8, 9, 10)
    expect.near({ p:get(1) }, { 8, 9, 10 }, 0)
    expect.truthy(rawequal(p:set(2, { 1, 2, 3 }), p))
    expect.near({ box:position(2) }, { 1, 2, 3 }, 0)
    expect.equal(p[25], nil)
    expect.equal(p[0], nil)
    expect.equal(p[1.5], nil)
    expect.equal(#p:table(), 24)
    expect.equal(type(p:pointer()), "userdata")
    p:changed()
    expect.error(function() p[1] = 0 / 0 end, "a position must be finite")
    expect.error(function() p[1] = "x" end, "a buffer holds numbers")
    expect.error(function() p[25] = 1 end, "the places 1 to 24")
    expect.error(function() p:get(9) end, "[out_of_range]")
    expect.error(function() p:set(1, { 1, 2 }) end, "a row of this buffer has 3 numbers, got 2")
    expect.error(function() p:gte(1) end, "no method 'gte'")
end)

test("it keeps its mesh alive, and refuses another topology", function()
    local box = lissom.shapes.box()
    local p = box:positions()
    local kept = lissom.shapes.box():positions()
    collectgarbage()
    collectgarbage()
    expect.equal(kept[1], -0.5)
    box:triangulate()
    expect.error(function() return p[1] end, "[topology_mismatch]")
    expect.error(function() return #p end, "[topology_mismatch]")
    expect.equal(tostring(p), "lissom.Buffer (out of date)")
end)

test("attributes", function()
    local grid = lissom.shapes.grid{ segments = 2 }
    local heat = grid:add_attribute{ name = "heat", width = 2, values = { 1, 2 } }
    expect.equal(heat:count(), 9)
    heat:set(3, { 5, 6 })
    expect.near({ grid:attribute("heat"):get(3) }, { 5, 6 }, 0)
    heat[1] = 0 / 0
    expect.truthy(heat[1] ~= heat[1])
    expect.equal(add_tags(grid)[4], 4)
    expect.equal(heat[6], 6)
    local info = grid:attributes()[2]
    expect.equal(info.name .. info.domain .. info.width .. info.type .. info.count, "tagface1uint84")
    expect.failure("out_of_range", grid.attribute, grid, "haet")
    expect.truthy(grid:remove_attribute("heat"))
    expect.error(function() return heat[1] end, "has gone or was replaced")
    expect.error(function()
        grid:add_attribute{ name = "tag", domain = "face", values = { 1, 2, 3 } }
    end, "4 are needed")
    expect.error(function()
        grid:add_attribute{ name = "x", domain = "edge" }
    end, "\"vertex\", \"corner\" or \"face\" expected")
end)

test("a mesh from the positions of another", function()
    local grid = lissom.shapes.grid{ segments = 2 }
    local tags = add_tags(grid)
    local twin = lissom.mesh{ positions = grid:positions(), faces = grid:faces() }
    expect.truthy(twin == grid)
    expect.error(function()
        lissom.mesh{ positions = tags, faces = {} }
    end, "three numbers a vertex")
end)

test("floats go into memory of the host, whole or not at all", function()
    local from, to = lissom.shapes.box():positions(), lissom.shapes.grid{ segments = 4 }:positions()
    for i = 1, #to do to[i] = 0 end
    expect.truthy(rawequal(from:write_floats(to:pointer(), 96), from))
    if string.pack then
        -- Two floats lie in the place of one double.
        local low, high = string.unpack("<ff", string.pack("<d", to[1]))
        expect.near({ low, high }, { from[1], from[2] }, 1e-6)
        expect.equal(to[13], 0)
    end
    local before = to:table()
    expect.error(function() from:write_floats(to:pointer(), 95) end, "8 rows need 96")
    expect.error(function() from:write_floats(to:pointer(), 96, { stride = 8 }) end, "a row needs 12")
    expect.error(function() from:write_floats(to:pointer(), 96, { offset = 1 }) end, "8 rows need 97")
    expect.error(function() from:write_floats(to:pointer(), 7 * 24 + 11, { stride = 24 }) end, "180")
    expect.error(function() from:write_floats(96, 96) end, "lightuserdata")
    expect.near(to:table(), before, 0)
    for i = 1, #to do to[i] = 0 end
    from:write_floats(to:pointer(), 7 * 24 + 12, { stride = 24 })
    if string.pack then
        local x, y, z, gap = string.unpack("<ffff", string.pack("<dd", to[4], to[5]))
        expect.near({ x, y, z, gap }, { from[4], from[5], from[6], 0 }, 1e-6)
    end
end)

test("LuaJIT reads and writes through a pointer", function()
    local has_ffi, ffi = pcall(require, "ffi")
    if not has_ffi then return end
    local grid = lissom.shapes.grid{ segments = 2 }
    local numbers = ffi.cast("double*", grid:positions():pointer())
    numbers[0] = 42
    grid:positions():changed()
    expect.equal((grid:position(1)), 42)
    numbers[4] = 0 / 0
    expect.failure("not_finite", function() return grid:positions():changed() end)
end)
