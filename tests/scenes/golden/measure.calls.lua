-- What was done with tools, as calls.
local lissom = require "lissom"

local scene = assert(dofile("cactus.lua"))
assert(scene:hash() == "65d4f1bf8be61cfe")
return scene
