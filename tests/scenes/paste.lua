-- Pasting by script: features put onto other surfaces, and what may come in between.
local lissom = require "lissom"

local ball, egg, region

local function horned(segments)
    local mesh = lissom.shapes.sphere{ segments = segments, kind = "triangles" }
    for i = 1, mesh:vertex_count() do
        local x, y, z = mesh:position(i)
        if y > 0 then
            local rise = math.exp(-14 * (x * x + z * z))
            mesh:set_position(i, x + 0.35 * rise * rise, y + 0.9 * rise, z)
        end
    end
    return mesh
end

local function pasted(options)
    local all = { source = ball, target = egg, region = region,
        placement = { at = { 0, 2, 0 }, scale = 0.8 } }
    for name, value in pairs(options or {}) do all[name] = value end
    return lissom.paste(all)
end

test.before(function()
    ball = horned(24)
    egg = lissom.shapes.sphere{ segments = 20 }:transform{ scale = { 1.4, 2, 1.6 } }
    region = ball:region{ sphere = { center = { 0, 1.3, 0 }, radius = 0.9 } }
end)

test("a horn is pasted where it is put, and the meshes stay as they are", function()
    local before = { ball:hash(), egg:hash() }
    local paste = pasted()
    local loop, search = paste:optimize()
    expect.truthy(loop:is_closed())
    expect.truthy(search.energy[#search.energy] <= search.energy[1])
    local mesh, report = paste:merge()
    expect.truthy(mesh:is_closed())
    expect.equal(mesh:components(), 1)
    expect.truthy(report.ok)
    expect.truthy(mesh:bounds().max[2] > 2.4)
    expect.equal(report.paste.euler_characteristic, report.paste.expected_characteristic)
    expect.equal(ball:hash(), before[1])
    expect.equal(egg:hash(), before[2])
end)

test("the part may be moved, and a move that fails leaves it where it was", function()
    local paste = pasted{ onto = egg:region{ plane = { point = { 0, 0.2, 0 }, normal = { 0, 1, 0 } } } }
    paste:optimize()
    local before = select(2, paste:loop()):points()
    local problem = expect.failure("boundary_conflict", paste.move, paste, { at = { 0, -2, 0 } })
    expect.truthy(problem.message:find("outside the region", 1, true))
    expect.equal(#select(2, paste:loop()):points(), #before)
    expect.truthy(paste:move{ at = { 0.5, 1.7, 0.4 }, scale = 0.6, angle = 90 })
    expect.truthy(paste:merge():is_closed())
end)

test("a part alone is that of a draft", function()
    local paste = pasted()
    paste:optimize()
    expect.truthy(paste:move{ at = { 0.3, 1.9, 0.2 }, search = false })
    local part, boundary, found = paste:draft()
    local mesh, report = paste:merge{ draft = true }
    expect.near(found.scale, report.paste.scale)
    expect.near(found.laid.energy, report.paste.laid.energy)
    expect.equal(found.kept_outline, report.paste.kept_outline)
    -- A seam at which faces would turn over is smoothed.
    local off = report.seam.smoothed == 0 and 1e-12 or 0.01 * found.scale
    for i = 1, #part do
        local x, y, z = part:position(i)
        expect.near(mesh:nearest(x, y, z).distance, 0, off)
    end
    expect.equal(#boundary:points(), #part:boundaries()[1]:points())
    expect.near(select(3, paste:draft{ scale = "lock" }).scale, 0.8)
end)

test("regions that cannot be pasted are refused", function()
    local problem = expect.failure("boundary_conflict", pasted, { feature = region })
    expect.truthy(problem.message:find("touches the outline", 1, true))
    expect.failure("topology_mismatch", pasted, { region = egg:region{ all = true } })
    -- The feature's outline is .28 from its middle at the size asked for; faces within .3 hold less.
    problem = expect.failure("boundary_conflict", pasted,
        { onto = egg:region{ sphere = { center = { 0, 2, 0 }, radius = 0.3 } } })
    expect.truthy(problem.message:find("does not fit", 1, true))
end)

test("attributes and regions of both come along", function()
    ball:set_region("tip", ball:region{ sphere = { center = { 0.3, 1.9, 0 }, radius = 0.3 } })
    egg:set_region("bottom", egg:region{ plane = { point = { 0, -1, 0 }, normal = { 0, -1, 0 } } })
    local paste = pasted()
    paste:optimize()
    local mesh, report = paste:merge{ scale = "lock" }
    expect.near(report.paste.scale, 0.8)
    expect.equal(#mesh:region("bottom"), #egg:region("bottom"))
    expect.equal(#mesh:region("tip"), #ball:region("tip"))
    expect.equal(report.provenance:vertex(1)[1].side, "target")
end)
