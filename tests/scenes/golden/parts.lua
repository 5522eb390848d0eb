-- A head and a stem, each cut open, side by side.
local lissom = require "lissom"
local head = lissom.shapes.head{ vertices = 4000 }
head = head:cut{ plane = { point = { 0, -0.15, 0 }, normal = { 0, 1, 0 }, seed = { 0, 0.1, 0 } } }
local stem = lissom.shapes.cactus{ ribs = 0, vertices = 4000 }
stem = stem:cut{ plane = { point = { 0, 1.7, 0 }, normal = { 0, -1, 0 } } }
local scene = lissom.scene{}
local turned = { axis = "x", angle = -40 }
scene:add("head", head:transform{ scale = 3, rotate = turned, translate = { -1.5, 1, 0 } })
turned = { axis = "x", angle = 25 }
scene:add("stem", stem:transform{ rotate = turned, scale = 0.7, translate = { 0, -0.6, 0 } })
return scene
