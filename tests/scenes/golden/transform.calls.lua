-- What was done with tools, as calls.
local lissom = require "lissom"

local scene = assert(dofile("parts.lua"))
scene:step("transform", function()
    scene:set("head", { transform = { { 1, 0, 0, 1.5 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } } })
end)
scene:step("transform", function()
    scene:set("head", { transform = { { 0.8660254037844387, 0, 0.49999999999999994, 1.2667555057822508 }, { 0, 1, 0, 0 }, { -0.49999999999999994, 0, 0.8660254037844387, -0.7413499034287164 }, { 0, 0, 0, 1 } } })
end)
assert(scene:hash() == "00adee5ba2486b23")
return scene
