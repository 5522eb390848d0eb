local lissom = require "lissom"

local function bar()
    local mesh = lissom.shapes.bar{ across = 2, along = 16 }
    local deformer = lissom.deformer(mesh)
    return mesh, deformer, deformer:add_handle(mesh:region("bottom")), deformer:add_handle(mesh:region("top"))
end

local function read_bytes(path)
    local file = assert(io.open(path, "rb"))
    local bytes = file:read("*a")
    file:close()
    return bytes
end

local mesh, deformer, bottom, top
-- How the handle and the mesh stand before every test.
local matrix, before

test.before(function()
    mesh, deformer, bottom, top = bar()
    top:translate(0.25, 0, 0)
    deformer:preview()
    matrix, before = top:matrix(), mesh:hash()
end)

local function pose(time)
    top:set{ rotate = { axis = "z", angle = 50 * time }, translate = { time, 0, 0 } }
end

local function expect_unchanged()
    expect.equal(mesh:hash(), before)
    expect.near(top:matrix()[1], matrix[1], 0)
end

test("save_basis writes the handles' weights, their names and the topology's size", function()
    local path = test.file("bar.basis")
    expect.truthy(rawequal(deformer:save_basis(path), deformer))
    local bytes = read_bytes(path)
    expect.equal(bytes:sub(1, 8), "LSMBASIS")
    expect.equal(#bytes, 64 + 16 * 2 + 16 * #mesh + 16 * 2 * #mesh + #"bottom" + #"top" + 2)
    expect.equal(bytes:sub(-11), "bottom\0top\0")
    assert(deformer:save_basis(path, { names = { "foot" } }))
    expect.equal(read_bytes(path):sub(-6), "foot\0\0")
    expect.error(function()
        deformer:save_basis(path, { names = { "a", "b", "c" } })
    end, "3 names for 2 handles")
    expect.failure("file_write_failed", deformer.save_basis, deformer, "no/such/folder/a.basis")
    bottom:remove()
    top:remove()
    expect.failure("unconstrained", deformer.save_basis, deformer, path)
end)

test("bake: shapes at the keys are those of solve, to the digits of a file", function()
    local function shape_at(baked, target)
        local shape = baked:copy()
        if target > 0 then
            local positions = shape:positions()
            local difference = baked:attribute("morph." .. target .. ".position")
            for i = 1, #positions do positions[i] = positions[i] + difference[i] end
        end
        return shape
    end
    local glb = test.file("bar.glb")
    for _, options in ipairs{ {}, { preview = true } } do
        local baked = deformer:bake{ pose = pose, times = { 0, 0.5, 2 }, preview = options.preview }
        expect.equal(mesh:hash(), before)
        expect.near(top:matrix()[1], matrix[1], 0)
        expect.truthy(rawequal(baked:save(glb), baked))
        local read = assert(lissom.load(glb))
        for target, time in pairs{ [0] = 0, 0.5, 2 } do
            local wanted = lissom.shapes.bar{ across = 2, along = 16 }
            local other = lissom.deformer(wanted)
            other:add_handle(wanted:region("bottom"))
            local handle = other:add_handle(wanted:region("top"))
            handle:set{ rotate = { axis = "z", angle = 50 * time }, translate = { time, 0, 0 } }
            if options.preview then other:preview() else other:solve() end
            local a, b = shape_at(read, target):positions(), wanted:positions()
            for i = 1, #a do expect.near(a[i], b[i], 2e-6) end
        end
    end
end)

test("bake: every frame starts from where the handles stand, and has its time and number", function()
    local calls = {}
    local baked = deformer:bake{ duration = 1, fps = 4, pose = function(time, frame)
        calls[#calls + 1] = { time, frame, top:matrix()[1][4] }
        top:translate(1, 0, 0)
    end }
    expect.equal(#calls, 5)
    for i, call in ipairs(calls) do expect.near(call, { (i - 1) / 4, i, 0.25 }, 0) end
    expect.truthy(baked:attribute("morph.1.position"))
    expect.failure("out_of_range", baked.attribute, baked, "morph.2.position")
    expect.truthy(baked:attribute("morph.1.normal"))
    baked = deformer:bake{ times = { 0 }, pose = pose, normals = false, interpolation = "step", name = "x" }
    expect.failure("out_of_range", baked.attribute, baked, "normal")
end)

test("bake: whatever the function does, handles and mesh are as they were", function()
    expect.error(function()
        deformer:bake{ duration = 1, fps = 4, pose = function(time)
            top:translate(1, 0, 0)
            if time > 0.4 then error("no more") end
        end }
    end, "no more")
    expect_unchanged()
    local thrown = {}
    local ok, got = pcall(deformer.bake, deformer, { duration = 1, pose = function() error(thrown) end })
    expect.truthy(not ok and rawequal(got, thrown))
    deformer:bake{ duration = 1, fps = 2, pose = function()
        top:translate(0, 1, 0)
        deformer:solve()
    end }
    expect_unchanged()
end)

test("bake: what `apply` takes afterwards is what was shown, and not the last pose", function()
    local shape, deformation, _, tip = bar()
    local normals = shape:add_attribute{ name = "normal", domain = "vertex", width = 3 }
    for i = 1, #shape do normals[3 * i - 2], normals[3 * i - 1], normals[3 * i] = shape:normal(i) end
    tip:rotate{ axis = "z", angle = 60 }
    deformation:solve()
    deformation:add_handle(shape:region{ box = { min = { nil, -0.2, nil }, max = { nil, 0.2, nil } } })
    local shown = shape:hash()
    assert(deformation:bake{ times = { 0 }, pose = function() tip:translate(1, 0, 0) end })
    expect.equal(shape:hash(), shown)
    deformation:rebase()
    expect.equal(shape:hash(), shown)
end)

test("bake: misuse", function()
    expect.error(function() deformer:bake{ pose = pose } end, "'bake' needs either 'duration' or 'times'")
    expect.error(function()
        deformer:bake{ pose = pose, times = { 0 }, duration = 1 }
    end, "'bake' needs either 'duration' or 'times'")
    expect.error(function() deformer:bake{ pose = pose, duration = 1e9 } end, "more than 10000 frames")
    expect.error(function() deformer:bake{ pose = pose, times = { 1, 0.5 } } end, "ascending")
    expect.error(function() deformer:bake{ pose = pose, times = {} } end, "[invalid_argument]")
    expect.error(function() deformer:bake{ duration = 1 } end, "pose")
    expect_unchanged()
end)

test("bake: a pose without a solution, a cancel and a handle that goes", function()
    local extra = deformer:add_handle(mesh:region{ where = function(_, _, y) return math.abs(y) < 0.2 end })
    assert(deformer:bake{ times = { 0, 1 }, pose = function(time) if time == 0 then extra:remove() end end })
    expect.equal(#deformer:handles(), 3)
    extra:remove()
    lissom.listen{ progress = function() return false end }
    local handle = deformer:add_handle(mesh:region{ where = function(_, _, y) return math.abs(y) < 0.2 end })
    expect.failure("cancelled", deformer.bake, deformer, { duration = 1, pose = pose })
    lissom.listen{}
    handle:remove()
    expect_unchanged()
    lissom.listen{ progress = function() error("in a listener") end }
    expect.error(function()
        deformer:bake{ duration = 1, pose = function(time)
            pose(time)
            bottom:translate(0, 0, 0)
            deformer:add_handle(mesh:region{ where = function(_, _, y) return math.abs(y - time) < 0.2 end })
        end }
    end, "in a listener")
    lissom.listen{}
    expect_unchanged()
    expect.error(function()
        deformer:bake{ duration = 1, pose = function() deformer:close() end }
    end, "[handle_removed]")
    expect.equal(mesh:hash(), before)
end)

-- ---- Compressed files and skins

-- The greatest distance of a vertex in any shape of two baked meshes.
local function max_difference(a, b)
    local worst = 0
    for target = 1, 1000 do
        local name = "morph." .. target .. ".position"
        local found, first = pcall(a.attribute, a, name)
        if not found then return worst, target - 1 end
        local second = b:attribute(name)
        for i = 1, #first do worst = math.max(worst, math.abs(first[i] - second[i])) end
    end
end

test("bake: with a tolerance a smooth animation has few targets, and the error is told", function()
    local cactus = lissom.shapes.cactus{ vertices = 4000 }
    local edit = lissom.deformer(cactus)
    edit:add_handle(cactus:region("base"))
    local tip = edit:add_handle(cactus:region("tip"))
    local function sway(time)
        tip:set{ rotate = { axis = "z", angle = 40 * math.sin(3 * time), about = { 0, 0.5, 0 } } }
    end
    local whole, told = edit:bake{ duration = 2, fps = 12, pose = sway }
    expect.equal(told.keys, 25)
    expect.equal(told.targets, 24)
    expect.equal(told.max_error, 0)
    local few, report = edit:bake{ duration = 2, fps = 12, pose = sway, tolerance = 0.001 * cactus:size() }
    expect.equal(report.keys, 25)
    expect.truthy(report.targets <= 8)
    expect.truthy(report.max_error > 0 and report.max_error <= 0.001 * cactus:size())
    expect.truthy(report.max_direction_error <= 0.02)
    local plain, small = test.file("whole.glb"), test.file("few.glb")
    whole:save(plain)
    few:save(small)
    expect.truthy(#read_bytes(small) < 0.4 * #read_bytes(plain))
    expect.error(function() edit:bake{ duration = 1, pose = sway, tolerance = -1 } end, "tolerance")
end)

test("bake_texture: four files, and a report that tells their error", function()
    local path = test.file("sway")
    local told = deformer:bake_texture(path, { pose = pose, duration = 1, fps = 8 })
    expect_unchanged()
    expect.equal(told.frames, 9)
    expect.equal(told.width * told.height, 9 * #mesh)
    expect.truthy(told.max_error < 1e-4 * mesh:size())
    expect.truthy(told.max_normal_error < 1e-4)
    for _, ending in ipairs{ "_positions.png", "_normals.png" } do
        expect.equal(read_bytes(path .. ending):sub(1, 8), "\137PNG\r\n\26\n")
    end
    expect.truthy(read_bytes(path .. ".json"):find('"coordinates": "TEXCOORD_1"', 1, true))
    expect.equal(#lissom.load(path .. ".glb"), #mesh)
    expect.failure("file_write_failed", deformer.bake_texture, deformer, "no/such/folder/a",
        { pose = pose, duration = 1 })
    expect.error(function() deformer:bake_texture(path, { pose = pose }) end, "'bake_texture' needs either")
    expect_unchanged()
end)

test("save_basis: key poses stand behind the basis, and handles and mesh are as they were", function()
    local plain, keyed = test.file("plain.basis"), test.file("keyed.basis")
    deformer:save_basis(plain)
    expect.truthy(rawequal(deformer:save_basis(keyed, { keys = { 0.5, 1 }, pose = pose }), deformer))
    expect_unchanged()
    local before_keys, bytes = read_bytes(plain), read_bytes(keyed)
    expect.equal(bytes:sub(1, #before_keys), before_keys)
    local first = math.ceil(#before_keys / 16) * 16
    expect.equal(bytes:sub(first + 1, first + 8), "LSMBKEYS")
    expect.truthy(#bytes > first + 2 * 12 * #mesh)
    expect.error(function() deformer:save_basis(keyed, { keys = { 1 } }) end, "both 'pose' and 'keys'")
    expect.error(function() deformer:save_basis(keyed, { pose = pose }) end, "both 'pose' and 'keys'")
    expect.error(function()
        deformer:save_basis(keyed, { keys = { 1, 1 }, pose = pose })
    end, "key poses 1 and 2 are the same")
    expect.error(function()
        deformer:save_basis(keyed, { keys = { 1 }, pose = function() error("no more") end })
    end, "no more")
    expect_unchanged()
    expect.equal(read_bytes(keyed), bytes)
end)

test("bake: a quantised, compressed animation is a quarter of the plain one and exact to its bits", function()
    local cactus = lissom.shapes.cactus{ vertices = 4000 }
    local edit = lissom.deformer(cactus)
    edit:add_handle(cactus:region("base"))
    local tip = edit:add_handle(cactus:region("tip"))
    local baked = edit:bake{ duration = 1, fps = 12, pose = function(time)
        tip:set{ rotate = { axis = "z", angle = 40 * time, about = { 0, 0.5, 0 } } }
    end }
    local plain, small = test.file("plain.glb"), test.file("small.glb")
    baked:save(plain)
    local saved = pcall(baked.save, baked, small, { compression = "meshopt", quantize = 12 })
    if not saved then return end -- a build without the codec
    expect.truthy(#read_bytes(small) < 0.25 * #read_bytes(plain))
    local difference, targets = max_difference(lissom.load(plain), lissom.load(small))
    expect.equal(targets, 12)
    expect.truthy(difference <= 2 / 2 ^ 12)
end)

test("skin: an ordinary skinned file of a deformation, with its error told", function()
    local rod = lissom.shapes.bar{ across = 4, along = 24 }
    local edit = lissom.deformer(rod)
    edit:add_handle(rod:region("bottom"))
    local upper = edit:add_handle(rod:region("top"))
    local hash = rod:hash()
    local function bend(time) upper:set{ rotate = { axis = "z", angle = 80 * time } } end
    local skinned, report = edit:skin{ joints = 6, duration = 1, fps = 8, pose = bend }
    expect.equal(rod:hash(), hash)
    expect.equal(report.joints, 6)
    expect.truthy(report.rms_error < report.max_error)
    expect.truthy(report.max_error < 0.05 * rod:size())
    local path = test.file("skin.glb")
    skinned:save(path)
    local back = lissom.load(path)
    expect.equal(#back, #rod)
    expect.equal(back:attribute("weights"):width(), 4)
    local _, turned = edit:skin{ joints = 6, angle = 20 }
    expect.truthy(turned.max_error < 0.05 * rod:size())
    expect.error(function() edit:skin{ duration = 1 } end, "'pose'")
end)

test("basis: its error at a turn is that which the guide tells", function()
    local rod = lissom.shapes.bar{}
    local edit = lissom.deformer(rod)
    edit:add_handle(rod:region("bottom"))
    local upper = edit:add_handle(rod:region("top"))
    local size = rod:size()
    local function positions(solve)
        solve(edit)
        local list = {}
        local buffer = rod:positions()
        for i = 1, #buffer do list[i] = buffer[i] end
        return list
    end
    local errors = { [10] = 0.02, [30] = 0.07, [50] = 0.14, [90] = 0.30, [130] = 0.47, [170] = 0.58 }
    for angle, told in pairs(errors) do
        upper:set{ rotate = { axis = "z", angle = angle } }
        local a, b, worst = positions(edit.preview), positions(edit.solve), 0
        for i = 1, #a, 3 do
            local x, y, z = a[i] - b[i], a[i + 1] - b[i + 1], a[i + 2] - b[i + 2]
            worst = math.max(worst, math.sqrt(x * x + y * y + z * z))
        end
        expect.near(worst / size, told, 0.006)
    end
end)
