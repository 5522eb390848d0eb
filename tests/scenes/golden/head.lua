-- A bald head.
local lissom = require "lissom"
local scene = lissom.scene{}
scene:add("head", lissom.shapes.head{ vertices = 4000 })
return scene
