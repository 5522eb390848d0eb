local lissom = require "lissom"

local function path(extension) return test.file("mesh" .. extension) end
local box = lissom.shapes.box{ size = { 1, 2, 3 } }

local function load_text(extension, text, options)
    local file = assert(io.open(path(extension), "wb"))
    file:write(text)
    file:close()
    return lissom.load(path(extension), options)
end

test("what is saved is loaded: faces, groups, regions where the format can", function()
    local cactus = lissom.shapes.cactus{ vertices = 2000 }
    for _, extension in ipairs{ ".obj", ".ply", ".off", ".stl" } do
        expect.truthy(rawequal(cactus:save(path(extension)), cactus))
        local back = assert(lissom.load(path(extension)))
        expect.near(back:area(), cactus:area(), 1e-5)
        if extension ~= ".stl" then expect.equal(back:face_count(), cactus:face_count()) end
    end
    cactus:save(path(".ply"), { binary = false })
    expect.equal(#lissom.load(path(".ply")), #cactus)
end)

test("axes and units", function()
    box:save(path(".obj"), { up = "z", unit = 10 })
    local turned = lissom.load(path(".obj"))
    expect.near(turned:bounds().max, { 0.05, 0.15, 0.1 })
    expect.near(lissom.load(path(".obj"), { up = "z", unit = 10 }):bounds().max, { 0.5, 1, 1.5 })
end)

test("the world's faults", function()
    expect.failure("file_not_found", lissom.load, path(".obj"))
    expect.failure("unknown_format", box.save, box, path(".doc"))
    expect.failure("file_write_failed", box.save, box, "/no/such/folder/x.obj")
    expect.failure("unknown_format", load_text, ".doc", "text")
    expect.failure("file_empty", load_text, ".obj", "")
    expect.failure("file_syntax", load_text, ".obj", "v 1 2 x\n")
    expect.failure("face_index", load_text, ".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")
    expect.failure("not_finite", load_text, ".obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
end)

test("what is mended is reported; without repair it is an error that names the elements", function()
    local folded = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\nf 1 2 2\n"
    local mended = assert(load_text(".obj", folded))
    expect.equal(#mended, 3)
    local report = mended:report()
    expect.equal(report.faces_collapsed.count, 1)
    expect.equal(report.faces_collapsed.element, "face")
    expect.equal(report.faces_collapsed.of, "file")
    expect.near(report.faces_collapsed.ids, { 2 })
    expect.near(report.vertices_unreferenced.ids, { 4 })
    expect.equal(report[1].kind, "faces_collapsed")
    local problem = expect.failure("repeated_vertex", load_text, ".obj", folded, { repair = false })
    expect.near(problem.elements.ids, { 2 })
    expect.truthy(problem.message:find("face 2;", 1, true))
end)

test("welding", function()
    local torn = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n"
    expect.equal(#load_text(".obj", torn), 4)
    expect.equal(#load_text(".obj", torn, { weld = "all" }), 4)
    expect.equal(#load_text(".obj", torn, { weld = false }), 6)
    expect.near(load_text(".obj", torn):report().vertices_welded.ids, { 4, 6 })
    local sheets = lissom.mesh{
        positions = { { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, { -1, 0, 0 } },
        faces = { { 1, 2, 3 }, { 1, 2, 4 }, { 1, 2, 5 } },
        repair = true,
    }
    expect.near(sheets:report().edges_nonmanifold.ids[1], { 1, 2 })
end)

test("misuse", function()
    expect.error(function() lissom.load(nil) end, "bad argument #1 to 'load' (string expected, got nil)")
    expect.error(function() lissom.load("a.obj", { unit = 0 }) end, "finite number above 0 expected, got 0")
    expect.error(function() lissom.load("a.obj", { weld = true }) end, "seams")
    expect.error(function() lissom.load("a.obj", { welt = "all" }) end, "welt")
end)

test("a mesh that is inside out is told, with the call that turns it", function()
    local place = path(".obj")
    local told = {}
    lissom.listen{ log = function(level, text) told[#told + 1] = level .. ": " .. text end }
    assert(lissom.shapes.sphere():flip():save(place))
    local inside_out = assert(lissom.load(place))
    expect.truthy(table.concat(told, "\n"):find("warning: 1 component inside out: the mesh is inside out; "
        .. "mesh:flip() turns it", 1, true))
    expect.truthy(inside_out:volume() < 0 and inside_out:flip():volume() > 0)
    told = {}
    assert(lissom.shapes.sphere():save(place))
    assert(lissom.load(place))
    expect.equal(#told, 0)
    lissom.listen{}
    expect.error(function() lissom.load("") end, "the path is empty")
    expect.error(function() box:save("") end, "the path is empty")
end)

-- The lines of the documents, with files in the folder of the test.
local ten_lines = [[
local lissom, head, body, points = ...
local mesh = lissom.load "scan.ply"          -- raises
local d = lissom.deformer(mesh)
d:pin(mesh:region "base")
local tip = d:add_handle(mesh:region "tip")
tip:rotate("z", 60)
d:solve()
mesh:save "bent.obj"
local out = lissom.merge(head, body)          -- nearest boundaries
local style = lissom.hairstyle(head)
style:add_stream(points); style:grow(200):save "hair.usda"
return mesh, out, style
]]

test("the ten lines that users write run as they are written", function()
    local folder = test.folder() .. "/"
    local scan = lissom.shapes.cactus{ vertices = 2000 }
    scan:save(folder .. "scan.ply")
    local bald = lissom.shapes.head{ vertices = 3000 }
    local low = bald:bounds().min[2] + 0.1 * bald:bounds().diagonal
    local head = bald:cut{ plane = { point = { 0, low, 0 }, normal = { 0, 1, 0 } } }
    local body = lissom.shapes.cylinder{ radius = 0.06, height = 0.3, segments = 40, caps = false }
        :transform{ translate = { 0, low - 0.2, 0 } }
    local style = lissom.hairstyle(head)
    local points = { style:at{ azimuth = 80, elevation = 50, lift = 0.01 },
        style:at{ azimuth = 90, elevation = 10, lift = 0.02 } }
    local text = ten_lines:gsub(' "([%w]+%.%w+)"', function(name) return ' "' .. folder .. name .. '"' end)
    local mesh, out, made = assert(load(text, "=ten lines"))(lissom, head, body, points)
    local tip = mesh:region("tip"):center()
    local angle = math.abs(math.atan(tip[1] - scan:region("tip"):center()[1], tip[2] - scan:bounds().min[2]))
    expect.truthy(mesh:hash() ~= scan:hash() and angle < math.pi)
    expect.equal(#lissom.load(folder .. "bent.obj"), #mesh)
    expect.equal(#out:boundaries(), 1)
    expect.equal(#made:curves(), 1)
    expect.equal(#lissom.load_strands(folder .. "hair.usda"), 200)
end)
