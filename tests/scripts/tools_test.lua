-- Tools and their host: gestures are steps, failures leave the scene as it was, what is recorded repeats.
local lissom = require "lissom"

local middle = { x = 640, y = 480 }

local function ball_scene()
    local scene = lissom.scene{}
    scene:add("ball", lissom.shapes.sphere())
    return scene
end

local function host_of(scene, tool, options)
    local camera = lissom.camera{ eye = { 0, 0, 5 } }
    return lissom.tool_host{ scene = scene, camera = camera, tool = tool, size = options and options.size }
end

-- Pulls the vertex under the cursor at each move.
local function pull()
    return lissom.tool{
        name = "pull",
        params = { step = { type = "number", default = 0.1, min = 0, max = 1 } },
        press = function(self, ev) self.hit = ev:hit() end,
        drag = function(self)
            if not self.hit then return end
            local mesh, v = self.hit.mesh, self.hit.vertex
            local x, y, z = mesh:position(v)
            mesh:set_position(v, x, y, z + self.params.step)
        end,
        cancel = function(self) self.cancelled = (self.cancelled or 0) + 1 end,
        draw = function(self, view)
            if self.hit then view:points{ points = { self.hit.position }, color = "#ff0000" } end
        end,
    }
end

local function drag(host, moves)
    host:press(middle)
    for i = 1, moves do host:move{ x = 640 + i, y = 480 } end
    return host:release{ x = 640 + moves, y = 480 }
end

test("a drag is one step; undo and redo give the same hashes", function()
    local scene = ball_scene()
    local host = host_of(scene, pull())
    local before, steps = scene:hash(), #scene:history()
    drag(host, 7)
    local after = scene:hash()
    expect.equal(#scene:history(), steps + 1)
    expect.equal(host:undo(), "pull")
    expect.equal(scene:hash(), before)
    expect.equal(host:redo(), "pull")
    expect.equal(scene:hash(), after)
end)

test("a gesture that changes nothing is no step", function()
    local scene = ball_scene()
    local host = host_of(scene, pull())
    local steps = #scene:history()
    host:click{ x = 1, y = 1 }
    expect.equal(#scene:history(), steps)
    expect.equal(scene:depth(), 0)
end)

test("Escape, undo and another tool in the middle of a drag take it back", function()
    local scene = ball_scene()
    local tool = pull()
    local host = host_of(scene, tool)
    local before = scene:hash()
    local ends = {
        function() host:key{ key = "escape" } end,
        function() expect.equal(host:undo(), nil) end,
        function() host:use(pull()) host:use(tool) end,
        function() host:use(nil) host:use(tool) end,
    }
    for _, finish in ipairs(ends) do
        host:press(middle):move{ x = 650, y = 480 }
        expect.equal(scene:depth(), 1)
        finish()
        expect.equal(scene:depth(), 0)
        expect.equal(scene:hash(), before)
        host:release(middle)
    end
    expect.equal(tool.cancelled, 2)
end)

test("an error in each function leaves the scene as it was, and names its line", function()
    for _, name in ipairs{ "press", "drag", "release", "key", "changed", "move" } do
        local scene = ball_scene()
        local tool = pull()
        tool[name] = function(_, ev)
            ev.scene:get("ball"):transform{ scale = 2 }
            error("no " .. name)
        end
        local host, before = host_of(scene, tool), scene:hash()
        local done, message = pcall(function()
            host:press(middle):move{ x = 641, y = 480 }
            host:release(middle):move(middle):key{ key = "a" }
            host:set{ step = 0.5 }
        end)
        expect.equal(done, false)
        expect.equal(message:match("tools_test.lua:%d+: no " .. name) ~= nil, true)
        expect.equal(scene:depth(), 0)
        if name ~= "key" and name ~= "changed" and name ~= "move" then expect.equal(scene:hash(), before) end
        tool[name] = nil
        host:use(nil)
        drag(host_of(scene, pull()), 1)
    end
end)

test("a tool neither changes the scene while it is drawn nor ends steps", function()
    local scene = ball_scene()
    local before = scene:hash()
    local host = host_of(scene, lissom.tool{ name = "wrong",
        draw = function(_, view) view.scene:get("ball"):transform{ scale = 2 } end })
    expect.error(function() host:draw() end, "changed the scene")
    expect.equal(scene:hash(), before)
    for _, verb in ipairs{ "commit", "rollback", "begin" } do
        local bad = host_of(scene, lissom.tool{ name = "bad", press = function(_, ev)
            ev.scene:get("ball"):transform{ scale = 2 }
            ev.scene[verb](ev.scene, "mine")
        end })
        pcall(function() bad:click(middle) end)
        expect.equal(scene:depth(), 0)
        scene:undo()
    end
end)

test("what a tool begins while it is drawn is taken back; a host's own steps are the host's", function()
    local scene = ball_scene()
    local before = scene:hash()
    local wrong = lissom.tool{ name = "wrong", draw = function(_, view) view.scene:begin("mine") end }
    local host = host_of(scene, wrong)
    for _ = 1, 3 do expect.equal(pcall(host.draw, host), false) end
    expect.equal(scene:depth(), 0)
    local ended = host_of(scene, lissom.tool{ name = "ended", press = function(_, ev)
        ev.scene:get("ball"):transform{ scale = 2 }
        pcall(ev.scene.commit, ev.scene)
        error("and then")
    end })
    expect.equal(pcall(function() ended:click(middle) end), false)
    expect.equal(scene:hash(), before)
end)

test("sizes and events that are none are refused, and nothing changes", function()
    local host = host_of(ball_scene(), pull())
    for _, size in ipairs{ { 0, 0 }, { 5 }, "x", { -5, -5 }, { 0 / 0, 1 }, { 1e9, 1e9 } } do
        expect.equal(pcall(host.look, host, host.camera, size), false)
    end
    expect.equal(host.size[1], 1280)
    expect.equal(pcall(host.press, host, 5), false)
    expect.equal(pcall(host.key, host), false)
    expect.equal(pcall(host.set, host, 3), false)
    expect.equal(pcall(host.look, host), false)
end)

test("draw answers what the tool shows, and refuses what is none", function()
    local host = host_of(ball_scene(), pull())
    expect.equal(#host:draw().points, 0)
    host:click(middle)
    expect.equal(host:draw().points[1].color, "#ff0000")
    local bad = { { "points", { points = { { 1, 2 } } } }, { "line", {} },
        { "label", { at = { 1, 2, 3 }, txt = 3 } },
        { "circle", { at = { 1, 2 }, radius = -1 } }, { "points", { points = {}, color = "red" } },
        { "mesh", {} }, { "mesh", { mesh = 3 } },
        { "mesh", { mesh = lissom.shapes.box{}, transform = { { 1, 0, 0 } } } } }
    for _, one in ipairs(bad) do
        local tool = lissom.tool{ name = "bad", draw = function(_, view) view[one[1]](view, one[2]) end }
        local other = host_of(ball_scene(), tool)
        expect.truthy(select(2, pcall(other.draw, other)).place:match("tools_test.lua"))
    end
end)

test("a mesh that is not in the scene is drawn, and is not hit", function()
    local box, hit = lissom.shapes.box{}:transform{ translate = { 0, 0, 1 } }, nil
    local place = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0.5 }, { 0, 0, 0, 1 } }
    local tool = lissom.tool{ name = "m", press = function(_, ev) hit = ev:hit() end,
        draw = function(_, view) view:mesh{ mesh = box, transform = place, color = "#aa8866" } end }
    local scene = ball_scene()
    local host = host_of(scene, tool)
    local drawn = host:draw().meshes[1]
    expect.equal(rawequal(drawn.mesh, box), true)
    expect.equal(drawn.transform[3][4], 0.5)
    host:click(middle)
    expect.equal(hit.object, "ball")
    expect.equal(#scene, 1)
end)

test("a gizmo is drawn", function()
    local gizmo = lissom.gizmo{ mode = "move" }
    local tool = lissom.tool{ name = "g", draw = function(_, view) view:gizmo(gizmo) end }
    local host = host_of(ball_scene(), tool)
    expect.equal(#host:draw().lines >= 3, true)
    host:move(middle)
    expect.equal(#host:draw().lines >= 3, true)
end)

test("a view whose camera was closed or whose size was changed draws no gizmo", function()
    local kept
    local keeps = lissom.tool{ name = "keeps", draw = function(_, view) kept = view end }
    local host = host_of(ball_scene(), keeps)
    host:draw()
    local gizmo = lissom.gizmo{ mode = "move" }
    expect.equal(rawequal(kept:gizmo(gizmo), kept), true)
    kept.size[1] = "wide"
    expect.error(function() kept:gizmo(gizmo) end, "size of the view")
    kept.size[1] = 640
    kept.camera:close()
    expect.error(function() kept:gizmo(gizmo) end, "camera of the view")
end)

test("parameters are checked, and a tool hears of changes", function()
    local heard = {}
    local tool = pull()
    tool.changed = function(_, ev) table.insert(heard, ev.parameter) end
    local host = host_of(ball_scene(), tool)
    host:set{ step = 0.25 }
    expect.equal(tool.params.step, 0.25)
    expect.equal(pcall(host.set, host, { step = 3 }), false)
    expect.equal(pcall(host.set, host, { stepp = 0.5 }), false)
    expect.equal(tool.params.step, 0.25)
    expect.equal(#heard, 1)
end)

test("what is no tool is refused", function()
    local function message(given) return select(2, pcall(lissom.tool, given)).message end
    expect.equal(message{ name = "a", pres = function() end }:match("did you mean 'press'") ~= nil, true)
    expect.equal(message{}:match("name") ~= nil, true)
    expect.equal(message{ name = "a", press = 3 }:match("function") ~= nil, true)
    local function nothing() end
    expect.equal(message{ name = "a", run = nothing, drag = nothing }:match("run") ~= nil, true)
    expect.equal(message{ name = "a", params = { x = { type = "numbr" } } }:match("params") ~= nil, true)
    local host = host_of(ball_scene())
    expect.equal(pcall(host.use, host, { name = "a" }), false)
    expect.equal(pcall(host.press, host, { x = 0 / 0, y = 1 }), false)
    expect.equal(pcall(host.press, host, { x = 1, y = 1, buton = "left" }), false)
end)

-- Lifts a vertex that is clicked by a length that is typed.
local function lift()
    return lissom.tool{ name = "lift", run = function()
        local hit = lissom.pick.vertex{ prompt = "Which?" }
        local length = lissom.pick.number{ prompt = "How far?", default = 0.5 }
        local x, y, z = hit.mesh:position(hit.vertex)
        hit.mesh:set_position(hit.vertex, x, y, z + length)
    end }
end

test("a tool that asks is answered, and begins again", function()
    local scene = ball_scene()
    local host = host_of(scene, lift())
    local _, _, z = scene:get("ball"):position(1)
    for round = 1, 3 do
        expect.equal(host:prompt(), "Which?")
        host:click{ x = 2, y = 2 }
        expect.equal(host:prompt(), "Which?")
        host:click(middle)
        host:type("0.27"):key{ key = "backspace" }
        expect.equal(host:prompt(), "How far? 0.2")
        host:key{ key = "enter" }
        expect.equal(#scene:history(), 1 + round)
    end
    expect.equal(z ~= nil, true)
    host:click(middle):key{ key = "escape" }
    expect.equal(host:prompt(), "Which?")
end)

test("a tool that asks takes a gesture by its press, and other clicks answer", function()
    local scene, drags, answers = ball_scene(), 0, 0
    local tool = lissom.tool{ name = "both", run = function()
        while true do
            lissom.pick.vertex{ prompt = "Where?" }
            answers = answers + 1
        end
    end, press = function(_, ev) return ev.shift end, drag = function() drags = drags + 1 end,
        release = function(_, ev) ev.scene:get("ball"):transform{ scale = 2 } end }
    local host = host_of(scene, tool)
    local before, steps = scene:hash(), #scene:history()
    host:press{ x = 640, y = 480, shift = true }:move{ x = 650, y = 480 }:release(middle)
    expect.equal(drags, 1)
    expect.equal(answers, 0)
    expect.equal(#scene:history(), steps + 1)
    host:undo()
    expect.equal(scene:hash(), before)
    host:press(middle):move{ x = 641, y = 480 }:release(middle)
    expect.equal(drags, 1)
    expect.equal(answers, 1)
    expect.equal(scene:hash(), before)
end)

test("a run that fails, yields at will or never asks leaves the host usable", function()
    local runs = {
        function() error("at once") end,
        function(_, ev) ev.scene:get("ball"):transform{ scale = 2 } coroutine.yield("nothing") end,
        function() lissom.pick.point{ prompt = "?" } error("later") end,
    }
    for _, run in ipairs(runs) do
        local scene = ball_scene()
        local before = scene:hash()
        local host = host_of(scene)
        local done = pcall(function() host:use(lissom.tool{ name = "bad", run = run }):click(middle) end)
        expect.equal(done, false)
        expect.equal(scene:hash(), before)
        expect.equal(host:prompt() == "?", host.asked == true)
        host:use(lift()):click(middle)
        expect.equal(host:prompt(), "How far? 0.5")
    end
    host_of(ball_scene(), lissom.tool{ name = "silent", run = function() end }):click(middle)
    expect.equal(pcall(lissom.pick.point, { prompt = "?" }), false)
end)

test("a boundary is picked with its loop", function()
    local ball = lissom.shapes.sphere()
    local scene = lissom.scene{}
    scene:add("cup", (ball:cut{ plane = { point = { 0, 0, 0 }, normal = { 0, -1, 0 } } }))
    local loop
    local host = host_of(scene, lissom.tool{ name = "loop", run = function()
        loop = lissom.pick.boundary{ prompt = "Loop?" }.boundary
    end })
    host:look(lissom.camera{ eye = { 0, 4, 3 } })
    local p = { scene:get("cup"):position(scene:get("cup"):boundaries()[1]:vertices()[1]) }
    local x, y = host.camera:project(p)
    host:move{ x = x, y = y }
    expect.equal(#host:draw().lines, 1)
    host:click{ x = x, y = y }
    expect.equal(#loop:vertices() > 3, true)
end)

local function read(text)
    local code = text:gsub('require%("lissom"%)%.replay', "")
    return assert(load(code))()
end

test("what is recorded is repeated to the same hash", function()
    local scene = ball_scene()
    local host = host_of(scene):record()
    host:use(pull())
    drag(host, 5)
    host:set{ step = 0.3 }
    drag(host, 2)
    host:press(middle):move{ x = 600, y = 480 }:key{ key = "escape" }
    host:undo()
    host:look(lissom.camera{ eye = { 0.3, 1, 4 }, fov = 37 }, { 800, 600 })
    host:click{ x = 400, y = 300 }
    host:press{ x = 400, y = 300 }:move{ x = 410, y = 300 }:release{ x = 410, y = 300 }
    host:use(lift()):click{ x = 400, y = 300 }:type("0.4"):key{ key = "enter" }
    local recorded = read(host:recording())
    local tools = { pull(), lift() }
    expect.equal(lissom.replay(recorded, { scene = ball_scene(), tools = tools }):hash(), recorded.after)
    -- Differences are named where they begin.
    local hashes = 0
    for _, event in ipairs(recorded.events) do
        if event.hash then hashes = hashes + 1 end
    end
    expect.equal(hashes >= 4, true)
    recorded.events[3][2] = 2
    local problem = expect.failure("invalid_argument", lissom.replay, recorded,
        { scene = ball_scene(), tools = tools })
    expect.truthy(problem.message:find("differs at event %d+"))
end)

test("a journal is a script of calls that comes to the same scene, without what failed", function()
    local scene = ball_scene()
    local host = host_of(scene):keep_journal():use(pull())
    drag(host, 5)
    host:press(middle):move{ x = 600, y = 480 }:key{ key = "escape" }
    host:set{ step = 0.3 }
    drag(host, 2)
    host:undo()
    host:show("ball", false):show("ball", true)
    host:use(lift()):click(middle):type("0.4"):key{ key = "enter" }
    local bad = lissom.tool{ name = "bad", press = function(_, ev)
        ev.scene:get("ball"):transform{ scale = 2 }
        error("no")
    end }
    expect.equal(pcall(function() host:use(bad):click(middle) end), false)
    local told = host:journal_text()
    expect.equal(told:find("scale", 1, true), nil)
    -- Of a drag that sets what it moves, the last says all.
    expect.equal(select(2, told:gsub("set_position", "")) <= 8, true)
    local other = ball_scene()
    assert(load(told))(other)
    expect.equal(other:hash(), scene:hash())
    local before = #scene:history()
    expect.equal(#other:history(), before)
end)

test("a journal tells two meshes apart that are alike", function()
    local scene = ball_scene()
    scene:add("twin", lissom.shapes.sphere())
    -- The first move selects on one of them, all others on its twin.
    local paint = lissom.tool{ name = "paint", drag = function(self, ev)
        local mesh = ev.scene:get(self.turned and "twin" or "ball")
        mesh:set_region("selected", mesh:region{ vertices = { 1, 2, 3 } })
        self.turned = true
    end }
    local host = host_of(scene):keep_journal():use(paint)
    drag(host, 3)
    local other = ball_scene()
    other:add("twin", lissom.shapes.sphere())
    assert(load(host:journal_text()))(other)
    expect.equal(other:hash(), scene:hash())
end)

test("a journal tells methods that change something and return another thing", function()
    local paint = lissom.tool{ name = "paint", press = function(_, ev)
        local mesh = ev.scene:get("ball")
        mesh:add_attribute{ name = "heat", values = 20 }
        mesh:add_attribute{ name = "cold", values = 3 }
        mesh:remove_attribute("cold")
        mesh:set_region("all", mesh:region{ all = true })
        mesh:remove_region("all")
        lissom.deform(mesh, { pin = mesh:region{ plane = { point = { 0, -0.5, 0 }, normal = { 0, -1, 0 } } },
            handles = { { region = mesh:region{ plane = { point = { 0, 0.5, 0 }, normal = { 0, 1, 0 } } },
                translate = { 0.2, 0, 0 } } } })
    end }
    local scene = ball_scene()
    local host = host_of(scene):keep_journal():use(paint):click(middle)
    local text, other = host:journal_text(), ball_scene()
    for _, name in ipairs{ "heat", "remove_attribute", "remove_region", "lissom.deform" } do
        expect.truthy(text:find(name, 1, true))
    end
    assert(load(text))(other)
    expect.equal(other:hash(), scene:hash())
end)

test("a journal says what calls do not tell", function()
    local scene = ball_scene()
    local host = host_of(scene):keep_journal()
    host:use(lissom.tool{ name = "odd", press = function(_, ev)
        local mesh = ev.scene:get("ball")
        mesh:set_region("up", mesh:region{ where = function(_, _, _, z) return z > 0 end })
        ev.scene:add("a \"quoted\" name\n", lissom.shapes.box():transform{ translate = { 1, 0, 0 } })
    end }):click(middle)
    expect.equal(host:journal_text():find("record events instead", 1, true) ~= nil, true)
    local calls = lissom.tool{ name = "named", press = function(_, ev)
        local box = ev.scene:get('a "quoted" name\n')
        box:set_region("front", box:region{ vertices = { 1, 2, 3, 5 } }:grow(1))
    end }
    local again = host_of(scene):keep_journal():use(calls):click(middle)
    local told = again:journal_text()
    scene:undo()
    assert(load(told))(scene)
end)

test("a recording of another scene or version is refused", function()
    local host = host_of(ball_scene()):record()
    drag(host:use(pull()), 1)
    local recorded = read(host:recording())
    local other = lissom.scene{}
    other:add("ball", lissom.shapes.box())
    expect.error(function() lissom.replay(recorded, { scene = other, tools = { pull() } }) end,
        "another scene")
    recorded.before = nil
    table.insert(recorded.events, 2, { "outside" })
    expect.error(function() lissom.replay(recorded, { scene = ball_scene(), tools = { pull() } }) end,
        "console changed the scene")
    recorded.version = 2
    expect.equal(pcall(lissom.replay, recorded, { scene = ball_scene() }), false)
    expect.equal(pcall(lissom.replay, "no such file.lua"), false)
    expect.equal(pcall(lissom.replay, { version = 1, events = { 3 } }, { scene = other }), false)
end)

test("recover takes back what was broken off, and nothing else", function()
    local scene = ball_scene()
    local host = host_of(scene):record():use(pull())
    drag(host, 2)
    host:recover()
    host:press(middle):move{ x = 641, y = 480 }
    host:recover()
    expect.equal(scene:depth(), 0)
    expect.equal(#scene:history(), 2)
    host:move(middle)
    local recorded = read(host:recording())
    expect.equal(lissom.replay(recorded, { scene = ball_scene(), tools = { pull() } }):hash(), scene:hash())
end)

test("what failed is not repeated", function()
    local function moody()
        local tool = pull()
        tool.release = function(self) if self.params.step > 0.5 then error("too far") end end
        return tool
    end
    local host = host_of(ball_scene()):record():use(moody())
    drag(host, 2)
    host:set{ step = 0.75 }
    expect.equal(pcall(drag, host, 3), false)
    host:set{ step = 0.2 }
    drag(host, 1)
    local recorded = read(host:recording())
    local scene = lissom.replay(recorded, { scene = ball_scene(), tools = { moody() } })
    expect.equal(scene:hash(), recorded.after)
end)

test("a tool whose object is removed while it is dragged", function()
    local scene = ball_scene()
    local tool = pull()
    local host = host_of(scene, tool)
    host:press(middle):move{ x = 641, y = 480 }
    scene:remove("ball")
    host:move{ x = 642, y = 480 }:release{ x = 642, y = 480 }
    expect.equal(#scene:names(), 0)
    host:undo()
    expect.equal(#scene:names(), 1)
end)

test("a recording sees by the very same camera", function()
    local seen = {}
    local function tool()
        return lissom.tool{ name = "see", press = function(_, ev)
            local origin, direction = ev:ray()
            table.insert(seen, { origin, direction, ev.camera:up(), ev.camera:fov() })
        end }
    end
    local host = host_of(ball_scene()):record():use(tool())
    for i = 1, 40 do
        local eye = { math.sin(i), math.cos(3 * i), 2 + math.sin(7 * i) }
        local up = { math.cos(i), 1, math.sin(2 * i) }
        host:look(lissom.camera{ eye = eye, up = up, fov = 20 + math.pi * i }, { 800, 600 })
        host:click{ x = 123, y = 45 + i }
    end
    local first = seen
    seen = {}
    lissom.replay(read(host:recording()), { scene = ball_scene(), tools = { tool() } })
    expect.equal(#seen, 40)
    for i, one in ipairs(seen) do
        for j = 1, 3 do
            for axis = 1, 3 do expect.truthy(one[j][axis] == first[i][j][axis]) end
        end
        expect.truthy(one[4] == first[i][4])
    end
end)

test("with z up the keys of sides turn with the view, and a recording keeps that", function()
    local scene = ball_scene()
    local function host_with(up)
        return lissom.tool_host{ scene = scene, camera = lissom.camera{ eye = { 0, 0, 5 } }, up = up }
    end
    local function seen(up, key)
        local camera = host_with(up):use(lissom.load_tool("navigate")):key{ key = key }.camera
        local eye, target = camera:eye(), camera:target()
        local away = {}
        for i = 1, 3 do away[i] = eye[i] - target[i] end
        return away, camera:up()
    end
    for _, key in ipairs{ "1", "2", "3", "4", "5", "6", "7" } do
        local y_away, y_up = seen("y", key)
        local z_away, z_up = seen("z", key)
        for i, from in ipairs{ 1, 3, 2 } do
            local sign = i == 2 and -1 or 1
            expect.near(z_away[i], sign * y_away[from], 1e-9)
            expect.near(z_up[i], sign * y_up[from], 1e-9)
        end
    end
    local ups = {}
    local asks = lissom.tool{ name = "asks", key = function(_, ev)
        ups[#ups + 1] = ev.up
        ev.scene:get("ball"):set_position(1, #ev.up, ev.up == "z" and 1 or 0, 0)
    end, draw = function(_, view) ups[#ups + 1] = view.up end }
    local host = host_with("z"):record()
    host:use(asks):look(lissom.camera{ eye = { 0, -5, 0 }, up = { 0, 0, 1 } }):key{ key = "a" }:draw()
    expect.equal(table.concat(ups), "zz")
    local recorded = assert(load((host:recording():gsub('require%("lissom"%)%.replay', ""))))()
    local after = scene:hash()
    host:undo()
    expect.equal(lissom.replay(recorded, { scene = scene, tools = { asks } }):hash(), after)
end)

test("a recording looks for its files from its own folder", function()
    local folder = test.file("recorded")
    os.execute("mkdir -p '" .. folder .. "'")
    assert(lissom.shapes.sphere{ segments = 8 }:save(folder .. "/ball.obj"))
    local function write(name, text)
        local stream = assert(io.open(folder .. "/" .. name, "w"))
        stream:write(text)
        stream:close()
    end
    write("grow.lua", [[return require("lissom").tool{ name = "grow",
        press = function(self, ev) ev.scene:get("ball"):transform{ scale = 2 } end }]])
    write("events.lua", [[-- What was done with tools; lissom run does it again.
return (require("lissom").replay{ version = 1, open = { "ball.obj" }, events = {
    { "tool", "grow.lua" }, { "press", 1, 1 }, { "release", 1, 1 } } })]])
    local size = assert(lissom.load(folder .. "/ball.obj")):size()
    for _, scene in ipairs{ lissom.replay(folder .. "/events.lua"), dofile(folder .. "/events.lua") } do
        expect.near(scene:get("ball"):size(), 2 * size)
    end
    os.remove(folder .. "/ball.obj")
    for _, run in ipairs{ lissom.replay, dofile } do
        local message = expect.failure("file_not_found", run, folder .. "/events.lua").message
        expect.truthy(message:find("ball.obj", 1, true) and message:find("its own folder", 1, true))
    end
end)

test("a scene keeps the parameters of tools, for the next host", function()
    local scene = ball_scene()
    host_of(scene, pull()):set{ step = 0.3 }
    expect.equal(scene:parameters("pull"), { step = 0.3 })
    local path = os.tmpname()
    assert(scene:save(path))
    local next_scene = assert(lissom.load_scene(path))
    os.remove(path)
    local tool = pull()
    local host = host_of(next_scene, tool)
    expect.near(tool.params.step, 0.3)
    host:set{ step = 0.1 }                              -- the default
    expect.equal(next_scene:parameters("pull"), nil)
    next_scene:set_parameters("pull", { step = 7, gone = "x" })
    expect.near(host_of(next_scene, pull()).tool.params.step, 0.1)      -- out of range: left out
end)

test("two hosts of one scene take turns: in the middle of a gesture the other is refused", function()
    local scene = ball_scene()
    local start = scene:hash()
    local one, other = host_of(scene, pull()), host_of(scene, pull())
    one:press(middle):move{ x = 641, y = 480 }
    local dragged = scene:hash()
    local calls = {
        function() other:press(middle) end, function() other:move(middle) end,
        function() other:release(middle) end, function() other:key{ key = "x" } end,
        function() other:set{ step = 0.3 } end, function() other:cancel() end,
        function() other:undo() end, function() other:redo() end, function() other:use(nil) end,
        function() other:use(pull()) end, function() other:show("ball", false) end,
    }
    local refused = "another host is in the middle of a gesture of 'pull'"
    for _, call in ipairs(calls) do expect.error(call, refused) end
    other:recover()
    expect.equal(scene:hash(), dragged)
    one:move{ x = 642, y = 480 }:release{ x = 642, y = 480 }
    expect.truthy(scene:hash() ~= dragged)
    drag(other, 2)
    expect.equal(scene:undo(), "pull")
    expect.equal(scene:undo(), "pull")
    expect.equal(scene:hash(), start)
    one:press(middle):cancel()                          -- a gesture that is taken back is over too
    drag(other, 1)
    expect.equal(#scene:history(), 2)
end)

-- Grows the ball with the wheel.
local function grow()
    return lissom.tool{
        name = "grow",
        press = function() end,
        wheel = function(self, ev)
            self.seen = ev
            ev.scene:get("ball"):transform{ scale = 1 + 0.1 * ev.lines * (ev.shift and 2 or 1) }
        end,
    }
end

test("the wheel is part of a gesture, or a step of its own, where a tool has a function for it", function()
    local scene = ball_scene()
    local host, before = host_of(scene, grow()), scene:hash()
    host:wheel{ x = 1, y = 2, lines = 1 }
    expect.equal(scene:history().place, 2)
    host:undo()
    expect.equal(scene:hash(), before)
    host:press(middle):wheel{ x = 640, y = 480, lines = 1 }:wheel{ x = 640, y = 480, lines = 2, shift = true }
    host:release(middle)
    expect.equal(scene:history().place, 2)
    expect.equal(host.tool.seen.lines, 2)
    expect.near(scene:get("ball"):bounds().max[1], 1.1 * 1.4)
    host:press(middle):wheel{ x = 640, y = 480, lines = 1 }:cancel()
    expect.near(scene:get("ball"):bounds().max[1], 1.1 * 1.4)
    host:use(pull()):wheel{ x = 1, y = 2, lines = 1 }
    expect.near(scene:get("ball"):bounds().max[1], 1.1 * 1.4)
    expect.error(function() host:wheel{ x = 1, y = 2 } end, "lines")
    expect.error(function() host:wheel{ x = 1, y = 2, lines = 1, button = "left" } end, "no 'button'")
end)

test("turns of the wheel are recorded and repeated, and told in the journal", function()
    local scene = ball_scene()
    local host = host_of(scene):record():keep_journal():use(grow())
    host:wheel{ x = 1, y = 2, lines = 1 }
    host:press(middle):wheel{ x = 640, y = 480, lines = -1, shift = true }:release(middle)
    local recorded = read(host:recording())
    expect.equal(lissom.replay(recorded, { scene = ball_scene(), tools = { grow() } }):hash(), recorded.after)
    local other = ball_scene()
    assert(load(host:journal_text()))(other)
    expect.equal(other:hash(), scene:hash())
end)

test("names that events, views and hosts do not have are told, with what was meant", function()
    local scene = ball_scene()
    local function fails_with(act, text)
        local host = host_of(scene, lissom.tool{ name = "wrong", press = function(_, ev) act(ev) end,
            draw = function(_, view) act(view) end })
        expect.error(function() host:click(middle) end, text)
        expect.error(function() host:draw() end, text)
    end
    fails_with(function(it) it:highlight() end, "no field or method 'highlight'; there is: ")
    fails_with(function(it) it:ht() end, "no field or method 'ht'")
    fails_with(function(it) return it.camrea end, "did you mean 'camera'?")
    local host = host_of(scene, lissom.tool{ name = "wrong",
        press = function(_, ev) return ev.lines, ev.key, ev.parameter, ev.late, ev.button end,
        draw = function(self, view) self.act(view) end })
    host:click(middle)
    local function refuses(act, text)
        host.tool.act = act
        expect.error(function() host:draw() end, text)
    end
    refuses(function(view) view:circle{ center = { 1, 2 } } end,
        "unknown option 'center' of 'circle', did you mean 'at'?")
    refuses(function(view) view:circle{ at = { 1, 2 }, radus = 3 } end, "did you mean 'radius'?")
    refuses(function(view) view:line{ whatever = 1 } end, "there is: points, color, width, closed")
    refuses(function(view) view:lable{} end, "lissom.ToolView: no field or method 'lable', did you mean")
    expect.error(function() host:clik(middle) end, "did you mean 'click'?")
    expect.error(function() host:click{ x = 1, y = 2, shfit = true } end, "did you mean 'shift'?")
end)

test("a tool that cannot begin leaves the one before in hand, and is not recorded", function()
    local scene = ball_scene()
    local host = host_of(scene):record():use(pull())
    local bad = lissom.tool{ name = "bad", params = { a = { type = "number", default = 1 } },
        activate = function(_, ev) ev.scene:get("ball"):transform{ scale = 2 } error("not today") end }
    bad.params.a = 2
    local before = scene:hash()
    expect.error(function() host:use(bad) end, "not today")
    expect.equal(scene:hash(), before)
    expect.equal(host.tool.name, "pull")
    drag(host, 2)
    local recorded = read(host:recording())
    expect.equal(lissom.replay(recorded, { scene = ball_scene(), tools = { pull() } }):hash(), scene:hash())
end)
