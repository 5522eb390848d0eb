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

local presets = { "afro", "bob", "braid", "bun", "messy", "mohawk", "ringlets", "spiky", "waves" }

test("every preset makes hair on a head that stays out of it, by parameters that it names", function()
    local head = lissom.shapes.head{ vertices = 6000 }
    for _, name in ipairs(presets) do
        local preset = require("presets." .. name)
        local style, hair, look = preset.grow(head, {}, { count = 400, resolution = 12000 })
        local stats = hair:stats{ style = style, depth = 0.001 }
        expect.truthy(#hair > 200, name)
        expect.equal(stats.not_finite, 0, name)
        expect.truthy(stats.penetrating <= 0.01 * #hair, name .. ": " .. stats.penetrating .. " inside")
        expect.truthy(look.unit > 0, name)
        expect.error(function() preset.grow(head, { bounce = 1 }) end, "no parameter 'bounce'")
    end
end)

test("another seed gives another head of hair, the same seed the same", function()
    local head = lissom.shapes.head{ vertices = 6000 }
    local preset = require "presets.spiky"
    local function hash(seed)
        local _, hair = preset.grow(head, { seed = seed }, { count = 200, resolution = 6000 })
        return hair:hash()
    end
    expect.equal(hash(2), hash(2))
    expect.truthy(hash(2) ~= hash(3))
end)
