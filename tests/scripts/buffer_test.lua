local lissom = require "lissom"
local expect = require "expect"

-- Positions without a copy: both ways, at once.
local box = lissom.shapes.box()
local p = box:positions()
expect.equal(#p, 24)
expect.equal(p:count(), 8)
expect.equal(p:width(), 3)
p[1] = 7
expect.equal((box:position(1)), 7)
box:set_position(1, 8, 9, 10)
expect.near_list({ p:get(1) }, { 8, 9, 10 }, 0)
expect.truthy(rawequal(p:set(2, { 1, 2, 3 }), p))
expect.near_list({ box:position(2) }, { 1, 2, 3 }, 0)
expect.equal(p[25], nil)
expect.equal(p[0], nil)
expect.equal(p[1.5], nil)
expect.equal(#p:table(), 24)
expect.equal(type(p:pointer()), "userdata")
p:changed()
expect.error("a position must be finite", function() p[1] = 0 / 0 end)
expect.error("a buffer holds numbers", function() p[1] = "x" end)
expect.error("the places 1 to 24", function() p[25] = 1 end)
expect.error("[out_of_range]", function() p:get(9) end)
expect.error("a row of this buffer has 3 numbers, got 2", function() p:set(1, { 1, 2 }) end)
expect.error("no method 'gte'", function() p:gte(1) end)

-- It keeps its mesh alive, and refuses another topology.
local kept = lissom.shapes.box():positions()
collectgarbage()
collectgarbage()
expect.equal(kept[1], -0.5)
box:triangulate()
expect.error("[topology_mismatch]", function() return p[1] end)
expect.error("[topology_mismatch]", function() return #p end)
expect.equal(tostring(p), "lissom.Buffer (out of date)")

-- Attributes.
local grid = lissom.shapes.grid{ segments = 2 }
local heat = grid:add_attribute{ name = "heat", width = 2, values = { 1, 2 } }
expect.equal(heat:count(), 9)
heat:set(3, { 5, 6 })
expect.near_list({ grid:attribute("heat"):get(3) }, { 5, 6 }, 0)
heat[1] = 0 / 0
expect.truthy(heat[1] ~= heat[1])
local tags = grid:add_attribute{ name = "tag", domain = "face", type = "uint8", values = { 1, 2, 3, 4 } }
expect.equal(tags[4], 4)
expect.equal(heat[6], 6)
local info = grid:attributes()[2]
expect.equal(info.name .. info.domain .. info.width .. info.type .. info.count, "tagface1uint84")
expect.failure("out_of_range", grid:attribute("haet"))
expect.truthy(grid:remove_attribute("heat"))
expect.error("has gone or was replaced", function() return heat[1] end)
expect.error("4 are needed", function()
    grid:add_attribute{ name = "tag", domain = "face", values = { 1, 2, 3 } }
end)
expect.error("\"vertex\", \"corner\" or \"face\" expected", function()
    grid:add_attribute{ name = "x", domain = "edge" }
end)

-- A mesh from the positions of another.
local twin = lissom.mesh{ positions = grid:positions(), faces = grid:faces() }
expect.truthy(twin == grid)
expect.error("three numbers a vertex", function()
    lissom.mesh{ positions = tags, faces = {} }
end)

-- LuaJIT reads and writes through a pointer.
local has_ffi, ffi = pcall(require, "ffi")
if has_ffi then
    local numbers = ffi.cast("double*", grid:positions():pointer())
    numbers[0] = 42
    grid:positions():changed()
    expect.equal((grid:position(1)), 42)
    numbers[4] = 0 / 0
    expect.failure("not_finite", grid:positions():changed())
end
