-- Tests of a scene: lissom test examples/test
local lissom = require "lissom"

local function bent(angle)
    local mesh = lissom.shapes.cactus{ vertices = 3000 }
    local deformer = lissom.deformer(mesh, { region = mesh:region{ all = true } })
    deformer:add_handle(mesh:region("base"))
    deformer:add_handle(mesh:region("tip")):rotate{ axis = { 0, 0, 1 }, angle = angle }
    deformer:solve()
    return mesh
end

test("a bend keeps the area", function()
    local rest = lissom.shapes.cactus{ vertices = 3000 }
    expect.near(bent(40):area() / rest:area(), 1, 0.05)
end)

test("a bend of nothing changes nothing", function()
    expect.hash(bent(0), lissom.shapes.cactus{ vertices = 3000 }:hash())
end)

test("a saved mesh is loaded again", function()
    local mesh = bent(40)
    mesh:save(test.file("bent.ply"))
    expect.near(lissom.load(test.file("bent.ply")):positions(), mesh:positions(), 1e-6)
    expect.failure("file_not_found", lissom.load, test.file("another.ply"))
end)

test("the bent cactus looks as it did", function()
    expect.picture({ mesh = bent(40), size = { 200, 200 }, view = "front" }, "golden/bent.png")
end)
