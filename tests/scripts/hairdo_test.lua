-- What scripts of hairstyles share.
local lissom = require "lissom"
local hairdo = require "hairdo"

test("a head whose unit nobody can guess gets it from the parameters, and nothing warns", function()
    local head = lissom.shapes.head{ vertices = 3000 }:transform{ scale = 3 }
    local told = {}
    lissom.listen{ log = function(level, message) told[#told + 1] = level .. ": " .. message end }
    expect.near(hairdo.scalp(head, { unit = 1 / 3 }):unit(), 1 / 3)
    local style = hairdo.style(head, { unit = 1 / 3, resolution = 6000 })
    local spine = {}
    for i, place in ipairs{ { 30, 0.02 }, { 20, 0.1 }, { 0, 0.15 } } do
        spine[i] = style:at{ azimuth = 180, elevation = place[1], lift = place[2] }
    end
    style:add_ponytail{ spine = spine, name = "tail" }
    local params = { out = test.folder(), name = "hair", format = "usda", detail = true }
    hairdo.finish(style, style:grow{ count = 500, length = 0.2 }, params)
    expect.equal(table.concat(told, "\n"), "")
    lissom.listen{}
    expect.truthy(#assert(lissom.load_strands(test.file("hair.usda"))) > 100)
end)
