local lissom = require "lissom"

test("plain shapes have the measures that were asked for", function()
    for shape, genus in pairs{ box = 0, bar = 0, sphere = 0, cylinder = 0, torus = 1 } do
        local mesh = lissom.shapes[shape]()
        expect.equal(mesh:genus(), genus)
        expect.truthy(mesh:is_closed() and mesh:volume() > 0)
    end
    expect.near(lissom.shapes.sphere{ radius = 2, segments = 64 }:area(), 16 * math.pi, 0.1)
    expect.near(lissom.shapes.box{ size = 3 }:volume(), 27)
    expect.equal(lissom.shapes.box{ segments = 2 }:face_count(), 24)
    expect.equal(lissom.shapes.box{ segments = { 1, 2, 3 } }:face_count(), 22)
    expect.equal(lissom.shapes.grid{ segments = { 4, 5 }, size = { 2, 1 } }:face_count(), 20)
    expect.equal(lissom.shapes.sphere{ kind = "triangles" }:check().triangles, true)
end)

test("the cactus and the head are as large as was asked for, and have their regions", function()
    local cactus = lissom.shapes.cactus{ vertices = 3000, height = 5 }
    expect.truthy(math.abs(#cactus - 3000) <= 300)
    expect.near(cactus:bounds().max[2], 5, 0.2)
    expect.equal(#cactus:regions(), 6)
    local head = lissom.shapes.head{ vertices = 3000, height = 40 }
    expect.truthy(math.abs(#head - 3000) <= 300 and head:is_closed())
    expect.near(head:bounds().max[2] - head:bounds().min[2], 40, 0.5)
    expect.truthy(#head:region("scalp") > 0 and #head:regions() == 3)
end)

test("measures that make no sense are refused", function()
    expect.error(function()
        lissom.shapes.head{ vertices = 10 }
    end, "integer from 3000 to 500000 expected, got 10")
    expect.error(function() lissom.shapes.sphere{ radius = -1 } end, "finite number above 0 expected, got -1")
    expect.error(function() lissom.shapes.torus{ segments = 2 } end, "integer of at least 3 expected, got 2")
    expect.error(function() lissom.shapes.box{ segments = { 1, 2 } } end, "integer or {x, y, z} expected")
    expect.error(function() lissom.shapes.torus{ radius = 1, tube_radius = 2 } end, "[invalid_argument]")
    expect.error(function() lissom.shapes.catcus() end, "did you mean 'cactus'?")
    expect.error(function() lissom.shapes.hat() end, "no function 'hat'")
end)
