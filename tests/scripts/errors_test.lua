-- What fails raises an error object; lissom.try returns it; under every Lua.
local lissom = require "lissom"

local box = lissom.shapes.box()

test("a failure is an object with a message, a code and the line of the script", function()
    local problem = expect.failure("file_write_failed", function() box:save("no/such/x.obj") end)
    expect.equal(tostring(problem), problem.message)
    expect.truthy(problem.message:find("no/such/x.obj", 1, true))
    expect.truthy(problem.place:find("errors_test.lua:7$"))
    expect.equal(problem.file, "no/such/x.obj")
    expect.equal(problem.line, nil)
    expect.equal("sadly, " .. problem, "sadly, " .. problem.message)
    expect.equal(getmetatable(problem), "lissom.Error")
end)

test("the line and the elements of a file are told", function()
    local path = test.file("bad.obj")
    local file = assert(io.open(path, "w"))
    file:write("v 0 0 0\nv 1 0 0\nv 0 1 y\n")
    file:close()
    local problem = expect.failure("file_syntax", lissom.load, path)
    expect.equal(problem.file, path)
    expect.equal(problem.line, 3)
    expect.equal(problem.elements.kind, "line")
    problem = expect.failure("nonmanifold_edge", lissom.mesh, { positions = {
        { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 1, 1, 1 } },
        faces = { { 1, 2, 3 }, { 2, 1, 4 }, { 1, 2, 5 } } })
    expect.equal(problem.elements, { kind = "edge", count = 1, ids = { { 1, 2 } } })
    expect.equal(problem.file, nil)
end)

test("misuse is such an object too", function()
    for _, wrong in ipairs{
        function() lissom.load(5) end, function() lissom.load("a.obj", { welt = 1 }) end,
        function() box.smooth() end, function() box:smoth() end, function() lissom.laod() end,
        function() lissom.shapes.bux() end, function() lissom.pick.point{ prompt = "?" } end,
        function() lissom.tool{ name = "" } end, function() lissom.tool{ name = "a", press = 1 } end,
        function() return box:positions() + 1 end, function() lissom.try() end,
    } do
        local _, problem = pcall(wrong)
        if type(problem) == "table" then
            expect.equal(problem.code, "invalid_argument")
        else
            expect.truthy(problem:find("arithmetic", 1, true))
        end
    end
    expect.equal(expect.failure("topology_mismatch", function()
        local mesh = lissom.shapes.grid()
        local region = mesh:region{ all = true }
        mesh:triangulate()
        region:grow(1)
    end).place:match("errors_test.lua"), "errors_test.lua")
end)

test("try returns results, or nil and the error", function()
    expect.equal({ lissom.try(function(...) return ... end, 1, 2, 3) }, { 1, 2, 3 })
    expect.equal(select("#", lissom.try(function() end)), 0)
    expect.equal(#assert(lissom.try(lissom.shapes.box)), 8)
    local mesh, problem = lissom.try(lissom.load, "none.obj")
    expect.equal(mesh, nil)
    expect.equal(problem.code, "file_not_found")
    local other = {}
    expect.truthy(rawequal(select(2, lissom.try(error, other)), other))
    local done, raised = pcall(function() assert(lissom.try(lissom.load, "none.obj")) end)
    expect.equal(done, false)
    expect.equal(raised.code, "file_not_found")
end)

test("an error is equal to itself alone, wherever it goes", function()
    local _, first = lissom.try(lissom.load, "none.obj")
    local _, second = lissom.try(lissom.load, "none.obj")
    expect.truthy(first ~= second)
    local done, same = pcall(error, first, 0)
    expect.truthy(not done and same == first)
    local inside = coroutine.create(function() error(first, 0) end)
    done, same = coroutine.resume(inside)
    expect.truthy(not done and same == first)
    done, same = pcall(coroutine.wrap(function() error(first, 0) end))
    expect.truthy(not done and same == first)
    done, same = pcall(box.region, box, { where = function() error(first, 0) end })
    expect.truthy(not done and same == first)
end)

test("what a tool calls raises through its host", function()
    local scene, caught = lissom.scene{}, nil
    scene:add("box", box)
    local host = lissom.tool_host{ scene = scene, camera = lissom.camera{ eye = { 0, 0, 5 } },
        tool = lissom.tool{ name = "saves", press = function(_, ev)
            caught = select(2, lissom.try(lissom.load, "none.obj"))
            ev.scene:get("box"):save("no/such/x.obj")
        end } }
    local problem = expect.failure("file_write_failed", host.press, host, { x = 1, y = 1 })
    expect.truthy(problem.place:find("errors_test.lua"))
    expect.equal(caught.code, "file_not_found")
    expect.equal(scene:depth(), 0)
end)

test("a script raises the same kind", function()
    local function half(path)
        lissom.error{ message = path .. ": half is missing", code = "file_truncated", file = path, line = 7,
            elements = { kind = "vertex", count = 1, ids = { 3 } }, level = 2 }
    end
    local problem = expect.failure("file_truncated", function() half("a.obj") end)
    expect.truthy(problem.place:find("errors_test.lua:104$"))
    expect.equal({ problem.file, problem.line, problem.elements.ids[1] }, { "a.obj", 7, 3 })
    expect.error(function() lissom.error{ message = "a", code = "file_truncatd" } end, "file_truncated")
    expect.equal(expect.failure("invalid_argument", lissom.error, { message = "a" }).message, "a")
end)

test("assert goes on working", function()
    local path = test.file("box.obj")
    expect.truthy(rawequal(assert(box:save(path)), box))
    expect.equal(#assert(lissom.load(path)), #box)
    expect.failure("file_not_found", function() assert(lissom.load("none.obj")) end)
end)

-- Names, files and values that are wrong for everything that takes one.
test("no function returns nil and a message", function()
    local function returned(f, ...)
        local done, first, second = pcall(f, ...)
        return done and first == nil and type(second) == "string"
    end
    local objects = { box, box:region{ all = true }, box:positions(), lissom.scene{},
        lissom.camera{ eye = { 0, 0, 5 } }, lissom.deformer(box), lissom.shapes.grid():boundaries()[1] }
    for _, object in ipairs(objects) do
        for _, name in ipairs{ "save", "load", "region", "attribute", "get", "info", "remove", "select",
            "solve", "preview", "basis", "bake", "cut", "fill", "trim", "save_basis", "hash" } do
            local found, method = pcall(function() return object[name] end)
            for _, value in ipairs{ "no/such/x.obj", test.file("nothing"), -1, 1e300, {}, true } do
                if found and method then
                    expect.truthy(not returned(method, object, value))
                    expect.truthy(not returned(method, object))
                end
            end
        end
    end
    for _, f in ipairs{ lissom.load, lissom.load_strands, lissom.load_style, lissom.load_scene,
        lissom.load_tool, lissom.replay, lissom.part.load } do
        for _, path in ipairs{ "", "no/such/x.obj", ".", "x.unknown", "no\nfile.obj", ("x"):rep(5000) } do
            local done, problem = pcall(f, path)
            expect.equal(done, false)
            expect.truthy(type(problem) == "table" and type(problem.code) == "string")
        end
    end
end)

test("a name of version 0.1 is an error that says what to write instead", function()
    local mesh = lissom.shapes.bar()
    local deformer = lissom.deformer(mesh)
    local head = lissom.shapes.sphere{ segments = 6 }
    local scalp = lissom.scalp(head, { up = "y", front = "z", region = head:region{ all = true } })
    local style = lissom.hairstyle(head, { resolution = 1000, scalp = scalp })
    local cup = head:cut{ plane = { point = { 0, 0, 0 }, normal = { 0, 1, 0 } } }
    -- In brackets, for lissom migrate rewrites the others.
    for advice, call in pairs{
        ["lissom.deformer(mesh, {...})"] = function() lissom.deform(mesh, {}) end,
        ["lissom.merger(source, target, {...})"] = function() return lissom["merging"] end,
        ["deformer:add_handle(region)"] = function() return deformer["handle"] end,
        ["deformer:rebase()"] = function() return deformer["apply"] end,
        ["deformer:subdivided_mesh()"] = function() return deformer["refined_mesh"] end,
        ["subdivide_borders = false"] = function() lissom.deformer(mesh, { ["refine_borders"] = false }) end,
        ["style:add_stream(points)"] = function() return style["stream"] end,
        ["style:add_dividing(points)"] = function() return style["dividing"] end,
        ["style:add_ponytail(spine)"] = function() return style["ponytail"] end,
        ["subdivide = false"] = function() lissom.merge{ ["refine"] = false } end,
        ["fidelity = \"default\""] = function() lissom.merge(cup, cup, { ["fidelity"] = "lissom" }) end,
    } do
        expect.error(call, advice)
    end
    expect.error(function() cup:fill(cup:boundaries()[1], { ["refine"] = true }) end, "subdivide")
    expect.error(function()
        lissom.paste{ source = mesh, target = mesh:copy(), region = mesh:region{ all = true },
            placement = { at = { 0, 0, 0 } }, ["fidelity"] = "lissom" }
    end, "fidelity = \"default\"")
end)
