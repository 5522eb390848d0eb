-- What a deformation holds: soft handles, points of faces and edges, paths; blends of posed meshes.
local lissom = require "lissom"

local function scene()
    local bar = lissom.shapes.bar{ across = 4, along = 20 }
    local deformer = lissom.deformer(bar)
    deformer:add_handle(bar:region("bottom"))
    return bar, deformer
end

local function point_of(mesh, face, weights)
    local p = { 0, 0, 0 }
    for k, v in ipairs(mesh:face(face)) do
        local x, y, z = mesh:position(v)
        p[1], p[2], p[3] = p[1] + weights[k] * x, p[2] + weights[k] * y, p[3] + weights[k] * z
    end
    return p
end

local function front_point(mesh)
    return mesh:pick({ 0.13, 1.02, 5 }, { 0, 0, -1 })
end

test("soft handles", function()
    local bar, deformer = scene()
    local top = deformer:add_handle(bar:region("top"), { weight = 1 })
    top:translate(1, 0, 0)
    deformer:solve()
    local x = select(1, bar:position(bar:region("top"):vertices()[1]))
    local rest = select(1, lissom.shapes.bar{ across = 4, along = 20 }:position(
        bar:region("top"):vertices()[1]))
    expect.truthy(x - rest > 0.1 and x - rest < 0.9)
    expect.error(function() deformer:add_handle(bar:region("top"), { weight = 0 }) end, "above 0")
end)

test("points of faces: where they were asked to be", function()
    local bar, deformer = scene()
    local hit = front_point(bar)
    local weights = { 0.4, 0.3, 0.2, 0.1 }
    local before = point_of(bar, hit.face, weights)
    deformer:constrain{ face = hit.face, bary = weights, position = { before[1] + 1, before[2], 0.2 } }
    expect.truthy(deformer:solve())
    expect.near(point_of(bar, hit.face, weights), { before[1] + 1, before[2], 0.2 })
    deformer:constrain{ face = hit.face, bary = weights }
    deformer:constrain{ triangle = hit.triangle, bary = hit.bary, position = { 0, 2, 1 } }
    deformer:solve()
    local sum = 0
    for k, v in ipairs(hit.triangle) do sum = sum + hit.bary[k] * select(3, bar:position(v)) end
    expect.near(sum, 1)
    deformer:constrain{ edge = { hit.triangle[1], hit.triangle[2] }, at = 0.25, position = { 0, 1, 0 } }
    deformer:reset()
end)

test("handles of points and of paths", function()
    local bar, deformer = scene()
    local hit = front_point(bar)
    local held = deformer:add_handle({ hit, { vertex = bar:region("top"):vertices()[1] } })
    held:translate(0, 0, 0.5)
    deformer:solve()
    local sum = 0
    for k, v in ipairs(hit.triangle) do sum = sum + hit.bary[k] * select(3, bar:position(v)) end
    expect.near(sum, hit.position[3] + 0.5)
    held:remove()
    local path = bar:path{ points = { { -0.5, 1.5, 0.5 }, { 0.5, 1.5, 0.5 } } }
    local drawn = deformer:add_handle(path, { weight = 5, gradient = false })
    expect.equal(#drawn:region(), #path:vertices())
    drawn:translate(0, 0, 0.5)
    expect.truthy(deformer:solve())
end)

test("stiffness: the middle of a bent bar stays straight where it is stiff", function()
    local function bend_of_middle(factor)
        local mesh, bent = scene()
        local bending = bent:add_handle(mesh:region("top"))
        bent:stiffness(mesh:region{ box = { min = { -1, -1, -1 }, max = { 1, 1, 1 } } }, factor)
        bending:rotate{ axis = "z", angle = 60 }:translate(1, 0, 0)
        bent:solve()
        local a = mesh:nearest(0.5, -1, 0).position
        local b = mesh:nearest(0.5, 1, 0).position
        local m = mesh:nearest((a[1] + b[1]) / 2, (a[2] + b[2]) / 2, 0).position
        return math.sqrt(((a[1] + b[1]) / 2 - m[1]) ^ 2 + ((a[2] + b[2]) / 2 - m[2]) ^ 2)
    end
    expect.truthy(bend_of_middle(200) < 0.5 * bend_of_middle(1))
end)

test("going on from a result", function()
    local bar, deformer = scene()
    local top = deformer:add_handle(bar:region("top"))
    top:translate(0.5, 0, 0)
    deformer:solve()
    local applied = bar:hash()
    expect.equal(deformer:rebase(), deformer)
    expect.equal(bar:hash(), applied)
    expect.equal(top:matrix()[1][4], 0)
    top:rotate{ axis = "z", angle = 30 }
    deformer:solve()
    deformer:reset()
    expect.equal(bar:hash(), applied)
    top:translate(0, 0.5, 0)
    deformer:solve()
    local moved = bar:hash()
    expect.equal(top:set_region(bar:region("top"):grow(1)), top)
    expect.equal(bar:hash(), moved)
    expect.near(top:matrix()[2][4], 0.5)
    expect.truthy(deformer:solve():hash() ~= moved)
end)

test("mirror images, falloffs and transitions", function()
    local bar, deformer = scene()
    local side = bar:region{ box = { min = { 0.4, -0.5, -1 }, max = { 1, 0.5, 1 } } }
    local mirror = { point = { 0, 0, 0 }, normal = { 2, 0, 0 } }
    local right = deformer:add_handle(side, { mirror = mirror, falloff = 0.5 })
    local left = right:mirrored()
    expect.equal(left:mirrored(), right)
    expect.equal(deformer:handles()[1]:mirrored(), nil)
    right:translate(0.5, 0.1, 0)
    expect.near(left:center(), { -right:center()[1], right:center()[2], right:center()[3] })
    deformer:solve()
    expect.near(bar:bounds().max[1], -bar:bounds().min[1])
    expect.truthy(bar:bounds().max[1] > 0.9)
    expect.failure("handle_overlap", deformer.add_handle, deformer, bar:region("top"), { mirror = mirror })
    expect.equal(#deformer:handles(), 3)
    expect.error(function()
        deformer:add_handle(bar:region("top"), { mirror = { point = { 0, 0, 0 }, normal = { 0, 0, 0 } } })
    end, "normal")

    local sheet = lissom.shapes.grid{ size = 4, segments = 24 }

    local function rim(transition)
        local mesh = sheet:copy()
        local inner = mesh:region{ sphere = { center = { 0, 0, 0 }, radius = 1.6 } }
        local part = lissom.deformer(mesh, { region = inner, transition = transition })
        part:add_handle(mesh:region{ sphere = { center = { 0, 0, 0 }, radius = 0.4 } }):translate(0, 1, 0)
        part:solve()
        return select(2, mesh:position(mesh:nearest(1.25, 0, 0).vertex))
    end
    expect.truthy(rim(0.8) < 0.6 * rim(0))
end)

test("a side with other vertices is mirrored by its nearest surface, and the residual is told", function()
    local bar = lissom.shapes.bar{ width = 1, length = 4, across = 6, along = 24 }
    local left = bar:region{ box = { min = { -9, -9, -9 }, max = { 1e-3, 9, 9 } } }
    bar = bar:subdivide{ region = left }
    local deformer = lissom.deformer(bar)
    local side = bar:region{ box = { min = { 0.4, -0.5, -9 }, max = { 9, 0.5, 9 } } }
    local right = deformer:add_handle(side, { mirror = { point = { 0, 0, 0 }, normal = { 1, 0, 0 } } })
    local box = right:mirrored():region():bounds()
    expect.near(box.min[2], -0.5, 0.1)
    expect.near(box.max[2], 0.5, 0.1)
    expect.truthy(#right:mirrored():region() > 1.5 * #side)
    local residual = right:mirror_residual()
    expect.truthy(residual.mean <= residual.max and residual.max < 1e-3)
    expect.equal(residual.warning, nil)
    expect.error(function() deformer:add_handle({ bar:nearest(0.5, -1.5, 0) }):mirror_residual() end,
        "no mirror image")
    -- Beside the middle.
    local other = lissom.deformer(bar):add_handle(side,
        { mirror = { point = { 0.05, 0, 0 }, normal = { 1, 0, 0 } } })
    residual = other:mirror_residual()
    expect.truthy(residual.max > 0.02 and residual.warning:find("middle", 1, true))
end)

test("misuse", function()
    local bar, deformer = scene()
    expect.error(function() deformer:stiffness(bar:region("top"), 0) end, "from 0.0001 to 100000")
    expect.error(function() deformer:add_handle({}) end, "list of points expected")
    expect.error(function() deformer:add_handle({ 7 }) end, "list of points expected")
    expect.error(function() deformer:add_handle({ { vertex = 0 } }) end, "ids of points are integers")
    expect.error(function() deformer:constrain{ position = { 0, 0, 0 } } end, "one of vertex, edge and face")
    expect.error(function() deformer:constrain{ face = 1, position = { 0, 0, 0 } } end,
        "face and bary together")
    expect.error(function() deformer:add_handle({ { face = 1, bary = { 0.5, 0.5, 0 } } }) end, "4 corners")
end)

-- ---- Posed meshes

local function bar() return lissom.shapes.bar{ across = 2, along = 20 } end

local function bent(angle)
    local mesh = bar()
    return lissom.deform(mesh, {
        pin = mesh:region("bottom"),
        handles = { { region = mesh:region("top"), rotate = { axis = "z", angle = angle } } },
    })
end

local function greatest_distance(a, b)
    local p, q = a:positions(), b:positions()
    local greatest = 0
    for i = 1, #p do greatest = math.max(greatest, math.abs(p[i] - q[i])) end
    return greatest
end

test("pose_space: rest, poses and paths are exact", function()
    local rest, half, whole = bar(), bent(60), bent(120)
    local space = lissom.pose_space{ rest = rest, poses = { bent = { half, whole }, back = bent(-40) } }
    expect.equal(tostring(space), "lissom.PoseSpace: 2 poses")
    expect.equal(space:names()[1], "back")
    expect.equal(greatest_distance(space:blend{}, rest), 0)
    expect.equal(greatest_distance(space:blend{ bent = 0.5 }, half), 0)
    expect.equal(greatest_distance(space:blend{ bent = 1, back = 0 }, whole), 0)
    expect.near(space:blend{ bent = 0.25 }:volume(), rest:volume(), 0.05 * rest:volume())
end)

test("pose_space: the poses are copies", function()
    local rest, pose = bar(), bent(60)
    local space = lissom.pose_space{ rest = rest, poses = { bent = pose } }
    local expected = pose:copy()
    pose:transform{ translate = { 5, 0, 0 } }
    rest:transform{ translate = { 5, 0, 0 } }
    expect.equal(greatest_distance(space:blend{ bent = 1 }, expected), 0)
end)

test("pose_space: bad input is refused", function()
    local rest, pose = bar(), bent(60)
    local function code(f, ...)
        local value, e = lissom.try(f, ...)
        return value == nil and e.code
    end
    local make = lissom.pose_space
    expect.equal(code(make, { rest = rest, poses = {} }), "invalid_argument")
    expect.equal(code(make, { rest = rest, poses = { a = {} } }), "invalid_argument")
    expect.equal(code(make, { rest = rest, poses = { a = lissom.shapes.box() } }), "topology_mismatch")
    for _, poses in ipairs{ { pose }, { a = 1 }, { a = { 1 } }, { a = { a = pose, pose, "x" } } } do
        expect.equal(code(make, { rest = rest, poses = poses }), "invalid_argument")
    end
    local space = make{ rest = rest, poses = { bent = pose } }
    local function blend(weights) return space:blend(weights) end
    local value, e = lissom.try(blend, { bend = 1 })
    expect.equal(value, nil)
    expect.equal(e.code, "out_of_range")
    expect.truthy(tostring(e):find("did you mean 'bent'", 1, true))
    expect.equal(code(blend, { bent = 0 / 0 }), "not_finite")
    expect.equal(code(blend, { bent = math.huge }), "not_finite")
    expect.equal(code(blend, { bent = "much" }), "invalid_argument")
    expect.equal(code(blend, { 0.5 }), "invalid_argument")
end)

test("pose_space: morph targets with correctives give the blend at their weights", function()
    local poses = { bent = { bent(45), bent(90) }, back = bent(-90) }
    local space = lissom.pose_space{ rest = bar(), poses = poses }
    local at = { { bent = 0.75 }, { back = 0.5 }, { back = 1, bent = 1 } }
    local mesh, report = space:targets{ correctives = at }
    expect.equal(#report.targets, 6)
    expect.equal(report.targets[1].name, "back")
    expect.falsy(report.targets[1].corrective)
    expect.equal(report.targets[3].name, "bent=0.5")
    expect.equal(report.targets[6].at.bent, 1)
    expect.truthy(report.error < 0.5 * report.linear_error)
    local path = os.tmpname() .. ".glb"
    mesh:save(path)
    local loaded = lissom.load(path)
    os.remove(path)
    local rest, half = loaded:positions(), space:blend{ bent = 0.5 }:positions()
    -- Weights of "bent", "bent=0.5" and "bent=0.75" at 0.5.
    local greatest, weights = 0, { [2] = 0.5, [3] = 1, [4] = 2 / 3 }
    local sum = {}
    for i = 1, #half do sum[i] = rest[i] end
    for target, weight in pairs(weights) do
        local changes = loaded:attribute("morph." .. target .. ".position")
        for i = 1, #half do sum[i] = sum[i] + weight * changes[i] end
    end
    for i = 1, #half do greatest = math.max(greatest, math.abs(sum[i] - half[i])) end
    expect.truthy(greatest < 1e-5)
    for _, correctives in ipairs{ { {} }, { { bent = 1 } }, { { bent = 0.5 } }, { 1 } } do
        local value, e = lissom.try(space.targets, space, { correctives = correctives })
        expect.equal(value, nil)
        expect.equal(e.code, "invalid_argument")
    end
end)

-- ---- Poses of a deformer

local function posed_bar()
    local mesh = bar()
    local deformer = lissom.deformer(mesh):pin(mesh:region("bottom"))
    local top = deformer:add_handle(mesh:region("top"))
    local straight = deformer:pose()
    top:rotate("z", 120):rotate("z", 120):rotate("z", 120)
    return mesh, deformer, top, straight, deformer:pose()
end

test("poses: they are values, and blend by the turns made", function()
    local mesh, deformer, top, straight, wound = posed_bar()
    expect.equal(tostring(wound), "lissom.Pose: 2 handles")
    deformer:set_pose(straight:blend(wound, 0.25))
    expect.near(top:matrix()[1][1], 0, 1e-9)
    deformer:solve()
    local quarter = mesh:copy()
    top:translate(1, 0, 0)
    deformer:set_pose(straight:blend(wound, 0.25)):solve()
    expect.equal(greatest_distance(mesh, quarter), 0)
    local _, other, _, foreign = posed_bar()
    for _, bad in ipairs{ function() other:set_pose(wound) end, function() wound:blend(foreign, 0.5) end } do
        local value, e = lissom.try(bad)
        expect.equal(value, nil)
        expect.equal(e.code, "invalid_argument")
    end
end)

test("poses: key poses are baked as a function that sets them", function()
    local mesh, deformer, top, straight, wound = posed_bar()
    local before = mesh:copy()
    local keys = { { time = 0, pose = straight }, { time = 1, pose = straight:blend(wound, 0.25) } }
    local baked, report = deformer:bake{ keys = keys, easing = "smooth", fps = 4 }
    expect.equal(report.keys, 5)
    expect.equal(greatest_distance(mesh, before), 0)
    local expected = deformer:bake{ duration = 1, fps = 4, pose = function(time)
        deformer:set_pose(straight:blend(wound, 0.25 * time * time * (3 - 2 * time)))
    end }
    for target = 1, 4 do
        local name = "morph." .. target .. ".position"
        local a, b = baked:attribute(name), expected:attribute(name)
        for i = 1, #a do expect.near(a[i], b[i], 1e-6) end
    end
    expect.near(top:matrix()[1][1], 1, 1e-9)
    local _, stepped = deformer:bake{ keys = keys, easing = "step", fps = 4, duration = 0.5 }
    expect.equal(stepped.targets, 0)
    local function refused(options)
        local value, e = lissom.try(deformer.bake, deformer, options)
        expect.equal(value, nil)
        expect.equal(e.code, "invalid_argument")
    end
    refused{ keys = {} }
    refused{ keys = { keys[2], keys[1] } }
    refused{ keys = keys, pose = function() end }
    refused{ duration = 1 }
    refused{ keys = keys, easing = "bouncy" }
end)
