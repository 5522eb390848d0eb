local lissom = require "lissom"

-- A scene of one deformation for each test.
local scene, bar, rest, deformer, top, before

test.before(function()
    scene = lissom.scene{}
    bar = lissom.shapes.bar()
    rest = bar:hash()
    deformer = scene:add("bend", lissom.deformer(bar))
    deformer:add_handle(bar:region("bottom"))
    top = deformer:add_handle(bar:region("top"))
    before = scene:hash()
end)

local function drag()
    scene:begin("drag")
    for angle = 20, 60, 20 do
        top:set{ rotate = { axis = "z", angle = angle } }
        deformer:solve{ draft = angle < 60 }
    end
    scene:commit()
    return bar:hash()
end

test("a deformation brings its mesh along; handles stay the same objects", function()
    expect.truthy(rawequal(scene:get("bend"), deformer))
    expect.equal(scene:info("bend").kind, "deformation")

    local bent, matrix = drag(), top:matrix()
    expect.equal(scene:undo(), "drag")
    expect.equal(bar:hash(), rest)
    expect.equal(top:matrix()[1][1], 1)
    expect.equal(scene:redo(), "drag")
    expect.equal(bar:hash(), bent)
    for row = 1, 4 do expect.near(top:matrix()[row], matrix[row], 0) end
    deformer:solve()
    expect.equal(bar:hash(), bent)
end)

test("what a script changed between two steps is found, and a handle that was added is gone", function()
    local bent = drag()
    deformer:add_handle({ bar:nearest(0.5, 0, 0) })
    expect.equal(#deformer:handles(), 3)
    expect.equal(scene:undo(), "edited")
    expect.equal(#deformer:handles(), 2)
    deformer:rebase()
    deformer:reset()
    expect.equal(bar:hash(), bent)
    expect.equal(scene:undo(), "edited")
    deformer:reset()
    expect.equal(bar:hash(), rest)
end)

test("the mesh has a name as well, and both show the same", function()
    scene:add("bar", bar)
    local both = scene:hash()
    scene:step("turn", function()
        top:rotate{ axis = "z", angle = 30 }
        deformer:solve()
    end)
    scene:undo()
    expect.equal(scene:hash(), both)
    expect.equal(bar:hash(), rest)
end)

test("after an error in the middle of a bend everything is as it was", function()
    expect.error(function()
        scene:step("fail", function()
            top:rotate{ axis = "z", angle = 30 }
            deformer:solve()
            error("stop")
        end)
    end, "stop")
    expect.equal(scene:hash(), before)
end)

test("what bake moves is put back, and no edit", function()
    scene:clear_history()
    assert(deformer:bake{ duration = 0.2, fps = 10, pose = function(t)
        top:rotate{ axis = "z", angle = 90 * t }
    end })
    expect.equal(scene:undo(), nil)
end)

test("a scene keeps what a script closes", function()
    deformer:close()
    local kept = scene:get("bend")
    expect.equal(#kept:handles(), 2)
    kept:handles()[2]:translate(1, 0, 0)
    kept:solve()
    expect.equal(scene:undo(), "edited")
    expect.equal(bar:hash(), rest)
end)

test("strands", function()
    local points = {}
    for k = 0, 9 do points[#points + 1] = { 0.001 * k * k, 0.01 * k, 0 } end
    local hair = scene:add("hair", lissom.strands{ points = points, counts = { 10 } })
    local straight = hair:hash()
    scene:step("noise", function() hair:noise{ amplitude = 0.01 } end)
    expect.truthy(hair:hash() ~= straight)
    expect.equal(scene:undo(), "noise")
    expect.equal(hair:hash(), straight)
    scene:step("trim", function() hair:trim{ length = 0.02 } end)
    expect.equal(scene:undo(), "trim")
    expect.equal(hair:hash(), straight)
    expect.equal(scene:info("hair").kind, "strands")
end)

test("a hairstyle with its curves", function()
    local head = lissom.shapes.head{}
    local style = scene:add("style", lissom.hairstyle(head, { resolution = 4000 }))
    local empty = scene:hash()
    local function at(azimuth, elevation)
        return style:at{ azimuth = azimuth, elevation = elevation, lift = 0.01 }
    end
    local curve
    scene:step("draw", function()
        curve = style:add_stream{ points = { at(10, 60), at(75, 35), at(90, -10) } }
    end)
    local drawn = scene:hash()
    local grown = style:grow{ count = 40 }:hash()
    scene:step("move", function() curve:set_points{ at(0, 60), at(60, 35) } end)
    expect.equal(scene:undo(), "move")
    expect.equal(scene:hash(), drawn)
    expect.equal(style:grow{ count = 40 }:hash(), grown)
    expect.equal(scene:undo(), "draw")
    expect.equal(scene:hash(), empty)
    expect.equal(#style:curves(), 0)
    expect.equal(scene:redo(), "draw")
    expect.equal(#curve:points(), 3)
    style:close()
    expect.equal(#scene:get("style"):curves(), 1)
end)

test("free curves", function()
    local line = scene:add("line", lissom.polyline{ points = { { 0, 0, 0 }, { 1, 0, 0 } } })
    scene:step("longer", function() line:set_points{ { 0, 0, 0 }, { 3, 0, 0 } } end)
    expect.equal(line:length(), 3)
    expect.equal(scene:undo(), "longer")
    expect.equal(line:length(), 1)
    expect.truthy(rawequal(scene:get("line"), line))
    expect.equal(tostring(line), "lissom.Polyline: 2 points")
end)

test("a scene is saved and loaded to the bit, and goes on", function()
    drag()
    local head = lissom.shapes.head{}
    scene:add("head", head, { visible = false, style = { color = "#aa8866" } })
    local style = scene:add("style", lissom.hairstyle(head, { resolution = 4000 }))
    local root = style:at{ azimuth = 10, elevation = 60, lift = 0.01 }
    local tip = style:at{ azimuth = 75, elevation = 35, lift = 0.01 }
    style:add_stream{ points = { root, tip } }
    scene:add("hair", style:grow{ count = 50 })
    scene:add("line", lissom.polyline{ points = { { 0, 0, 0 }, { 1, 0.1, 0 } }, closed = true })

    local path = os.tmpname()
    local saved, left_out = scene:save(path)
    expect.truthy(rawequal(saved, scene))
    expect.equal(#left_out, 0)
    local again = assert(lissom.load_scene(path))
    os.remove(path)
    expect.equal(again:hash(), scene:hash())
    expect.equal(table.concat(again:names(), " "), "bend head style hair line")
    expect.equal(again:undo(), nil)

    local other = again:get("bend")
    expect.equal(other:mesh():hash(), bar:hash())
    expect.truthy(rawequal(again:get("bend"), other))
    for _, one in ipairs{ deformer, other } do
        one:handles()[2]:rotate{ axis = "z", angle = 10 }
        assert(one:solve())
    end
    expect.equal(other:mesh():hash(), bar:hash())
    expect.equal(again:undo(), "edited")
    expect.equal(again:get("style"):grow{ count = 50 }:hash(), style:grow{ count = 50 }:hash())
    expect.equal(again:info("head").visible, false)
end)

test("a scene comes back from a folder, with its parameters and its history", function()
    scene:add("bar", bar)
    for i = 1, 3 do
        scene:step("turn " .. i, function()
            top:rotate{ axis = "z", angle = 10 }
            assert(deformer:solve())
        end)
    end
    scene:undo()
    scene:set_parameters("bend", { angle = 20, mirror = true, axis = "z" })
    local path = os.tmpname()
    os.remove(path)
    for _, where in ipairs{ path .. "/", path .. ".lissom" } do
        expect.truthy(rawequal(scene:save(where, { history = true }), scene))
        local again = assert(lissom.load_scene(where))
        expect.equal(again:hash(), scene:hash())
        expect.equal(again:parameters("bend"), { angle = 20, mirror = true, axis = "z" })
        expect.equal(again:parameters("cut"), nil)
        expect.equal(again:redo(), "turn 3")
        expect.equal(again:redo(), nil)
        local names = {}
        for name in function() return again:undo() end do table.insert(names, name) end
        expect.equal(names[1], "turn 3")
        expect.equal(#names, #scene:history())
        expect.equal(#assert(lissom.load_scene(where, { history = 0 })):history(), 0)
    end
    local file = assert(io.open(path .. "/scene.json"))
    expect.truthy(file:read("a"):find('"file": "bar.obj"', 1, true))
    file:close()
    scene:set_parameters("bend", {})
    expect.equal(scene:parameters("bend"), nil)
    expect.error(function() scene:set_parameters("bend", { angle = {} }) end, "booleans, numbers")
    expect.error(function() scene:set_parameters("bend", { 1 }) end, "names")
    expect.failure("file_write_failed", scene.save, scene, path .. ".lissom", { form = "folder" })
    os.execute("rm -r " .. path .. " " .. path .. ".lissom")
end)

test("a file that is no scene is refused", function()
    local path = os.tmpname()
    expect.failure("file_empty", lissom.load_scene, path)
    local file = assert(io.open(path, "wb"))
    file:write(("no scene "):rep(200))
    file:close()
    expect.failure("file_syntax", lissom.load_scene, path)
    os.remove(path)
    expect.failure("file_not_found", lissom.load_scene, path)
    expect.failure("file_write_failed", scene.save, scene, path .. "/no/scene.lissom")
end)

test("a scene that is closed in a step, or loses an object while it is asked for, does no harm", function()
    scene:step("close", function()
        bar:flip()
        scene:close()
    end)
    expect.error(function() scene:hash() end, "Scene")
    local other = lissom.scene{}
    expect.error(function()
        other:step("close", function()
            other:close()
            error("closed")
        end)
    end, "closed")
end)

test("a scene and a style of version 0.1 load, and their objects have the present names", function()
    local here = package.searchpath("models", package.path):match("^(.*/)")
    local old = here .. "../scenes/golden/version_0_1/"
    local saved = lissom.load_scene(old .. "scene")
    expect.equal(saved:get("bar"):hash(), "134de93d9b818fc1")
    expect.equal(#saved:get("bend"):handles(), 2)
    saved:get("bend"):handles()[2]:rotate("z", 10)
    expect.truthy(saved:get("bend"):solve())
    expect.equal(#saved:get("style"):curves(), 2)
    expect.equal(#saved:get("hair"), 10)
    expect.equal(#lissom.load_style(old .. "style.json", saved:get("head"),
        { scalp = saved:get("style"):scalp() }):curves(), 2)
end)
