local lissom = require "lissom"

local size = { 640, 480 }
local camera = lissom.camera{ eye = { 0, 0, 5 }, ortho = 4.8 }      -- a pixel is a hundredth
local box = lissom.shapes.box()
local grid = lissom.shapes.grid{ size = { 2, 2 }, segments = { 4, 4 } }
grid:transform{ rotate = { axis = "x", angle = 90 } }
local whole = { { 0, 0 }, { 640, 480 } }

-- The options of a pick at a point of the plane z = 0.
local function at(x, y, options)
    options.x, options.y, options.size = 320 + 100 * x, 240 - 100 * y, size
    return options
end

local function moved(x, y, z)
    return { { 1, 0, 0, x }, { 0, 1, 0, y }, { 0, 0, 1, z }, { 0, 0, 0, 1 } }
end

-- Two boxes and a line above them.
local function scene_of_boxes()
    local scene = lissom.scene{}
    scene:add("left", box:copy(), { transform = moved(-1, 0, 0) })
    scene:add("right", box:copy(), { transform = moved(1, 0, 1) })
    scene:add("guide", lissom.polyline{ points = { { -2, 1, 0 }, { 2, 1, 0 } } })
    return scene
end

test("a face with all that tools are given", function()
    local hit = camera:pick(at(0.1, 0.2, { mesh = box }))
    expect.equal(hit.kind, "face")
    expect.equal(hit.index, hit.face)
    expect.truthy(rawequal(hit.mesh, box))
    expect.equal(hit.object, nil)
    expect.near(hit.position, { 0.1, 0.2, 0.5 })
    expect.near(hit.normal, { 0, 0, 1 })
    expect.near(hit.depth, 4.5)
    expect.near(hit.bary[1] + hit.bary[2] + hit.bary[3], 1)
    local same = box:pick({ 0.1, 0.2, 5 }, { 0, 0, -1 })
    expect.equal(hit.face, same.face)
    expect.equal(hit.vertex, same.vertex)
    expect.equal(hit.triangle, same.triangle)
    expect.equal(camera:pick(at(2, 2, { mesh = box })), nil)
end)

test("vertices, edges and boundaries within the radius, one kind or several", function()
    local hit = camera:pick(at(0.47, 0.48, { mesh = box, kinds = "vertex" }))
    expect.near(hit.position, { 0.5, 0.5, 0.5 })
    expect.equal(hit.index, hit.vertex)
    expect.near(hit.pixels, math.sqrt(13))
    expect.equal(camera:pick(at(0.47, 0.48, { mesh = box, kinds = "vertex", radius = 3 })), nil)
    hit = camera:pick(at(0.1, 0.47, { mesh = box, kinds = { "face", "edge" } }))
    expect.equal(hit.kind, "edge")
    local a, b = hit.ends[1], hit.ends[2]
    expect.near((1 - hit.along) * box:position(a) + hit.along * box:position(b), 0.1)
    hit = camera:pick(at(0.97, 0.3, { mesh = grid, kinds = { "boundary", "face" } }))
    expect.equal(hit.kind, "boundary")
    expect.equal(grid:boundaries()[hit.index]:vertices()[hit.segment], hit.ends[1])
    expect.near(hit.position, { 1, 0.3, 0 })
end)

test("handles are over everything, unless they are said not to be", function()
    local middle = { points = { { 1, 1, 1 }, { 0, 0, 0 } }, mesh = box, kinds = { "point", "face" } }
    local hit = camera:pick(at(0.02, 0, middle))
    expect.equal(hit.kind, "point")
    expect.equal(hit.index, 2)
    expect.equal(hit.face, nil)
    middle.points_on_top = false
    expect.equal(camera:pick(at(0.02, 0, middle)).kind, "face")
end)

test("objects of a scene are picked where they stand, and only those that are visible", function()
    local scene = scene_of_boxes()
    local hit = camera:pick(at(1.1, 0.1, { scene = scene }))
    expect.equal(hit.object, "right")
    expect.near(hit.position[3], 1.5)
    expect.truthy(rawequal(hit.mesh, scene:get("right")))
    expect.equal(camera:pick(at(-1.1, 0.1, { scene = scene })).object, "left")
    hit = camera:pick(at(0.5, 1.02, { scene = scene, kinds = "polyline" }))
    expect.equal(hit.object, "guide")
    expect.near(hit.along, 0.625)
    scene:set("right", { visible = false })
    expect.equal(camera:pick(at(1.1, 0.1, { scene = scene })), nil)
end)

test("a mesh is picked in its present shape, after changes and after undo", function()
    local scene = scene_of_boxes()
    local function height() return camera:pick(at(-1.1, 0.1, { scene = scene })).position[3] end
    expect.near(height(), 0.5)
    scene:step("lift", function() scene:get("left"):transform{ translate = { 0, 0, 2 } } end)
    expect.near(height(), 2.5)
    scene:undo()
    expect.near(height(), 0.5)
end)

test("a deformation is picked by its mesh, and a style by its curves", function()
    local scene = lissom.scene{}
    local bar = lissom.shapes.box{ segments = { 4, 4, 4 } }
    scene:add("edit", lissom.deformer(bar, { region = bar:region{ all = true } }))
    expect.equal(camera:pick(at(0.1, 0.1, { scene = scene })).object, "edit")
    scene:add("bar", bar)
    expect.equal(#camera:pick_all(at(0.1, 0.1, { scene = scene, through = true })), 2)
    local style = lissom.hairstyle(lissom.shapes.head{})
    local curve = style:add_stream{ points = { { 0, 0.2, 0.1 }, { 0, 0.3, 0 }, { 0, 0.2, -0.1 } } }
    scene:add("style", style)
    local top = curve:points()[2]
    local view = lissom.camera{ eye = { top[1], top[2] + 2, top[3] + 0.01 }, target = top }
    local x, y = view:project(top, size)
    local hit = view:pick{
        scene = scene, kinds = "polyline", radius = 30, through = true, x = x, y = y, size = size,
    }
    expect.equal(hit.object, "style")
    expect.equal(hit.index, 1)
end)

test("all along the ray", function()
    local options = at(0.1, 0.2, { meshes = { box, grid }, through = true })
    local hits = camera:pick_all(options)
    expect.equal(#hits, 3)
    expect.truthy(hits[1].depth < hits[2].depth and hits[2].depth < hits[3].depth)
    expect.truthy(rawequal(hits[2].mesh, grid))
    options.most = 2
    expect.equal(#camera:pick_all(options), 2)
end)

test("rectangle, lasso and brush give regions", function()
    local ball = lissom.shapes.sphere{ segments = 8 }
    local seen = camera:select{ mesh = ball, rectangle = whole, size = size }[1]
    local through = camera:select{ mesh = ball, rectangle = whole, size = size, through = true }[1]
    expect.equal(#through.region, #ball)
    expect.truthy(#seen.region > 0.4 * #ball and #seen.region < 0.7 * #ball)
    expect.truthy(rawequal(seen.mesh, ball))
    for _, v in ipairs(seen.region:vertices()) do expect.truthy(select(3, ball:position(v)) > -1e-9) end
    local outline = { { 0, 0 }, { 640, 0 }, { 640, 480 }, { 0, 480 } }
    local around = camera:select{ mesh = ball, lasso = outline, size = size }[1]
    expect.equal(around.region:vertices(), seen.region:vertices())
    local brush = { stroke = { { 320, 240 } }, radius = 1 }
    local dab = camera:select{ mesh = ball, brush = brush, what = "faces", size = size }[1]
    expect.truthy(#dab.faces >= 1 and #dab.faces <= 4)
    expect.truthy(dab.region:contains(ball:face(dab.faces[1])[1]))
end)

test("a selection in a scene has one entry a surface, hidden by the others", function()
    local scene = scene_of_boxes()
    local found = camera:select{ scene = scene, rectangle = whole, size = size }
    expect.equal(#found, 2)
    expect.equal(found[1].object, "left")
    expect.equal(#found[1].region, 4)
    scene:add("curtain", grid, { transform = moved(-1, 0, 2) })
    found = camera:select{ scene = scene, rectangle = whole, size = size }
    expect.equal(#found[1].region, 0)
    expect.equal(#found[2].region, 4)
end)

test("picks and selections without sense are refused", function()
    expect.error(function() camera:select{ mesh = box } end, "give one of rectangle, lasso and brush")
    expect.error(function() camera:select{ mesh = box, rectangle = { { 1, 2 } } } end, "corners")
    expect.error(function() camera:select{ mesh = box, lasso = { { 1, 2, 3 } } } end, "{x, y}")
    expect.error(function() camera:pick(at(0, 0, { kinds = { "corner" } })) end, "edge or face expected")
    expect.error(function() camera:pick(at(0, 0, { kinds = "corner" })) end, "corner")
    expect.equal(camera:pick(at(0, 0, {})), nil)
end)

test("hair is picked by its strands, where it is seen, and after each change", function()
    local scene = lissom.scene{}
    local hair = lissom.strands{ counts = { 3, 2, 2 }, points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 },
        { 0, -1, 1 }, { 1, -1, 1 }, { 0, 0.2, -1 }, { 1, 0.2, -1 } } }
    scene:add("hair", hair, { transform = moved(-0.5, 0, 0) })
    local function look(x, y, more)
        local options = at(x, y, { scene = scene, kinds = { "polyline", "face" } })
        for key, value in pairs(more or {}) do options[key] = value end
        return camera:pick(options)
    end
    local hit = look(0.47, 0.5)
    expect.equal(hit.kind, "polyline")
    expect.equal(hit.object, "hair")
    expect.equal(hit.index, 1)
    expect.equal(hit.segment, 2)
    expect.near(hit.position, { 0.5, 0.5, 0 })
    expect.near(hit.pixels, 3)
    expect.equal(look(0.1, -0.96).index, 2)
    expect.equal(look(0.1, -0.96, { radius = 3 }), nil)
    expect.equal(look(0.1, 0.22).index, 3)
    hair:transform{ translate = { 0, 0.7, 0 } }
    expect.equal(look(0.1, -0.96), nil)
    expect.equal(look(0.1, -0.28).index, 2)
    scene:add("box", box:copy())                        -- before the third, behind the second
    expect.equal(look(0.1, -0.28).index, 2)
    expect.equal(look(-0.3, 0.88).index, 3)
    scene:get("box"):transform{ translate = { 0, 0.7, 0 } }
    expect.equal(look(-0.3, 0.88).kind, "face")
    expect.equal(look(-0.3, 0.88, { through = true }).index, 3)
    scene:set("hair", { visible = false })
    expect.equal(look(0.1, -0.28, { kinds = "polyline" }), nil)
end)

test("hair in metres is picked where it is drawn on a head of another unit", function()
    local head = lissom.shapes.head{ vertices = 3000 }:transform{ scale = 100 }
    local style = lissom.hairstyle(head, { resolution = 4000 })
    style:add_stream{ points = { style:at{ azimuth = 20, elevation = 50, lift = 0.01 },
        style:at{ azimuth = 80, elevation = 0, lift = 0.02 } } }
    local hair = style:grow{ count = 200, length = 0.2 }
    local scene = lissom.scene{}
    scene:add("head", head)
    scene:add("hair", hair)
    local view = lissom.frame(head, { view = "left" })
    local found = 0
    for i = 1, #hair do
        local strand = hair:strand(i)
        local unit, n = style:scalp():unit(), #strand
        local x, y = view:project({ strand[n - 2] / unit, strand[n - 1] / unit, strand[n] / unit }, size)
        local hit = view:pick{ scene = scene, x = x, y = y, size = size, kinds = "polyline", radius = 2 }
        if hit then found = found + 1 end
    end
    expect.truthy(found > 40)
end)
