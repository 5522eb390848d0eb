-- A detailed mesh to be bent.
local lissom = require "lissom"
local scene = lissom.scene{}
scene:add("cactus", lissom.shapes.cactus{ vertices = 6000 })
return scene
