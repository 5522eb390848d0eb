local lissom = require "lissom"
local expect = require "expect"

-- Objects are the very ones that were added.
local scene = lissom.scene{}
local bar = scene:add("bar", lissom.shapes.bar())
expect.truthy(rawequal(scene:get("bar"), bar))
expect.equal(#scene, 1)
expect.equal(tostring(scene), "lissom.Scene: 1 objects, 1 steps")
expect.failure("out_of_range", scene:get("baz"))
local _, message = scene:get("baz")
expect.truthy(message:find("bar"))
expect.failure("out_of_range", scene:info("baz"))
expect.error("has an object 'bar'", function() scene:add("bar", lissom.shapes.box()) end)
expect.error("expected", function() scene:add("n", 7) end)

-- Undo puts the content back into them, whatever holds them: regions, buffers, queries.
local rest, count = bar:hash(), #bar
local top = bar:region("top")
local buffer = bar:positions()
scene:step("bend", function()
    local edit = lissom.deform(bar)
    edit:handle(bar:region("bottom"))
    edit:handle(top):rotate{ axis = "z", angle = 60 }
    edit:solve()
end)
local bent, x = bar:hash(), buffer[1]
scene:step("refine", function() bar:append(lissom.shapes.box()) end)
expect.error("topology_mismatch", function() return top:center() and bar:extract(top) end)
expect.equal(scene:undo(), "refine")
expect.equal(bar:hash(), bent)
expect.equal(#bar, count)
expect.truthy(bar:extract(top))
expect.equal(buffer[1], x)
expect.equal(scene:undo(), "bend")
expect.equal(bar:hash(), rest)
expect.equal(bar:nearest(0, 100, 0).position[2], bar:bounds().max[2])
expect.equal(scene:redo(), "bend")
expect.equal(bar:hash(), bent)
expect.equal(scene:undo(), "bend")

-- Typed buffers and single positions are found too.
bar:add_attribute{ name = "heat", domain = "vertex", width = 1 }
scene:step("none", function() end)
bar:attribute("heat")[1] = 0.5
expect.equal(scene:undo(), "edited")
expect.truthy(bar:attribute("heat")[1] ~= 0.5)
expect.equal(scene:undo(), "edited")
expect.error("heat", function() assert(bar:attribute("heat")) end)
bar:set_position(1, 9, 9, 9)
expect.equal(scene:undo(), "edited")
expect.equal(bar:hash(), rest)

-- A closed mesh is an empty one, and comes back.
bar:close()
expect.equal(scene:undo(), "edited")
bar = scene:get("bar")
expect.equal(bar:hash(), rest)

-- A step gives back what its function returns; after an error everything is as it was.
local a, b, c = scene:step("values", function() return 1, nil, "three" end)
expect.equal(a, 1)
expect.equal(b, nil)
expect.equal(c, "three")
local before = scene:hash()
expect.error("out of coffee", function()
    scene:step("fail", function()
        bar:triangulate()
        scene:add("box", lissom.shapes.box())
        scene:remove("bar")
        error("out of coffee")
    end)
end)
expect.equal(scene:hash(), before)
local table_error = {}
local done, caught = pcall(scene.step, scene, "fail", function() error(table_error) end)
expect.truthy(not done and rawequal(caught, table_error))

-- Steps end where they began.
expect.error("did not end it", function()
    scene:step("open", function()
        bar:flip()
        scene:begin("inner")
    end)
end)
expect.error("ends with its function", function()
    scene:step("ended", function()
        bar:flip()
        scene:commit()
    end)
end)
expect.error("is open", function() scene:step("undone", function() scene:undo() end) end)
expect.error("no step to commit", function() scene:commit() end)
expect.error("no step to roll back", function() scene:rollback() end)
expect.equal(scene:hash(), before)
scene:step("outer", function()
    bar:flip()
    scene:begin("inner")
    bar:flip()
    scene:rollback()
    pcall(scene.step, scene, "inner", function()
        bar:transform{ scale = 2 }
        error("x")
    end)
end)
expect.equal(scene:undo(), "outer")
expect.equal(scene:hash(), before)

-- A drag is one step.
scene:begin("drag")
for _ = 1, 5 do bar:transform{ translate = { 0.1, 0, 0 } } end
expect.equal(scene:commit(), true)
expect.equal(scene:undo(), "drag")
scene:begin("nothing")
expect.equal(scene:commit(), false)
expect.equal(scene:redo(), "drag")
expect.equal(scene:undo(), "drag")

-- In a coroutine, too.
local drag = coroutine.wrap(function()
    scene:begin("slow drag")
    coroutine.yield()
    bar:flip()
    coroutine.yield()
    scene:commit()
end)
for _ = 1, 3 do drag() end
expect.equal(scene:undo(), "slow drag")

-- Names, order and looks.
scene:add("box", lissom.shapes.box(), { visible = false, style = { color = "#ff0000", shading = "flat" } })
expect.equal(table.concat(scene:names(), " "), "bar box")
expect.truthy(rawequal(scene:move("box", 1), scene))
scene:rename("bar", "beam")
expect.equal(table.concat(scene:names(), " "), "box beam")
local entry = scene:info("box")
expect.equal(entry.kind, "mesh")
expect.equal(entry.visible, false)
expect.equal(entry.style.shading, "flat")
expect.near_list(entry.style.color, { 1, 0, 0 })
local moved = { { 1, 0, 0, 5 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } }
scene:set("box", { transform = moved, visible = true })
expect.equal(scene:info("box").transform[1][4], 5)
expect.equal(scene:info("box").style.shading, "flat")
expect.error("no colour", function() scene:set("box", { style = { color = "#ff00" } }) end)
expect.error("colours", function() scene:set("box", { style = { color = { 0, 0, 2 } } }) end)
expect.error("flattens", function()
    scene:set("box", { transform = { { 1, 0, 0, 0 }, { 0, 0, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } } })
end)
expect.error("has no object 'bar'", function() scene:remove("bar") end)
expect.equal(scene:undo(), "change box")
expect.equal(scene:undo(), "rename bar")
expect.equal(scene:undo(), "move box")
expect.equal(scene:undo(), "add box")
expect.equal(scene:hash(), before)

-- What the history holds is bounded and told.
local small = lissom.scene{ history = 3e5 }
local grid = small:add("grid", lissom.shapes.grid{ segments = { 63, 63 } })
for i = 1, 10 do
    small:step("lift " .. i, function() grid:transform{ translate = { 0, 1, 0 } } end)
end
local history = small:history()
expect.equal(#history, 3)
expect.equal(history.place, 3)
expect.equal(history.dropped, 8)
expect.equal(history[1].name, "lift 8")
expect.equal(history[1].bytes, 64 * 64 * 24)
expect.truthy(history.bytes <= history.limit)
small:undo()
expect.equal(small:history().place, 2)
expect.truthy(rawequal(small:clear_history(), small))
expect.equal(small:undo(), nil)

-- What a scene holds lives as long as the scene.
do
    local held = lissom.scene{}
    held:add("box", lissom.shapes.box())
    collectgarbage()
    collectgarbage()
    expect.equal(#held:get("box"), 8)
    held:close()
    expect.error("Scene", function() held:hash() end)
end
