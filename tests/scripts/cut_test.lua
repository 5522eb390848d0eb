local lissom = require "lissom"
local cactus = lissom.shapes.cactus{ vertices = 4000 }
local hash = cactus:hash()
local arm_height = { cactus:region("left_arm"):center()[1], 1.4, 0 }
local tip, trunk, loops = cactus:cut{ plane = { point = arm_height, normal = { 0, 1, 0 } } }
local torus = lissom.shapes.torus()
local ball = lissom.shapes.sphere{ kind = "triangles", segments = 16 }
local points = {}
for i = 1, 10 do
    local angle = -i * math.pi / 5
    points[i] = { math.cos(angle), 0.2 + 0.1 * math.cos(2 * angle), math.sin(angle) }
end
local region = ball:region{ plane = { point = { 0, 0.2, 0 }, normal = { 0.3, 1, 0 } } }
local most = ball:region{ plane = { point = { 0, 0.8, 0 }, normal = { 0, -1, 0 } } }

test("by a plane: the line nearest to the point, the side of the normal or of a seed", function()
    expect.equal(cactus:hash(), hash)
    expect.equal(#loops, 1)
    expect.equal(#loops.b, 1)
    expect.truthy(rawequal(loops[1]:mesh(), tip) and rawequal(loops.b[1]:mesh(), trunk))
    expect.truthy(loops[1]:is_boundary() and loops.b[1]:is_boundary())
    expect.equal(loops.report.lines_left, 2)
    expect.truthy(loops.report.divided_faces > 0 and #loops.report.slid_vertices > 0)
    expect.equal(#loops.report.touched_boundaries, 0)
    expect.truthy(tip:bounds().max[1] < 0)
    local there, back = loops[1]:points(), loops.b[1]:reversed():points()
    for i = 1, #there do
        for k = 1, 3 do expect.equal(there[i][k], back[i][k]) end
    end
    local kept = cactus:cut{ plane = { point = arm_height, normal = { 0, 1, 0 }, seed = { 0, 0, 0 } } }
    expect.equal(#kept, #trunk)
    kept = cactus:cut{ plane = { point = arm_height, normal = { 0, 1, 0 } }, seed = { 0, 0, 0 } }
    expect.equal(#kept, #trunk)
    local above = cactus:cut{ plane = { point = arm_height, normal = { 0, 1, 0 }, loops = "all" } }
    expect.equal(above:components(), 3)
end)

test("what stands in the way is said", function()
    local problem = expect.failure("boundary_conflict", torus.cut, torus,
        { plane = { point = { 1, 0, 0 }, normal = { 0, 0, 1 } } })
    expect.truthy(problem.message:find("does not separate", 1, true))
    expect.equal(problem.elements.kind, "edge")
    local grid = lissom.shapes.grid()
    local _, _, line = grid:cut{ plane = { point = { 0.03, 0, 0 }, normal = { 1, 0, 0.2 } } }
    expect.truthy(not line[1]:is_closed())
    expect.equal(line.report.touched_boundaries[1], 1)
    expect.equal(line.report.warnings[1].kind, "touches_boundary")
    expect.truthy(#line.report.warnings[1].message > 20 and #line.report.warnings[1].vertices == 2)
end)

test("by a path through points or vertices, and by a region", function()
    local cap, rest, ring = ball:cut{ path = points }
    expect.truthy(cap:bounds().max[2] > 0.9 and rest:bounds().min[2] < -0.9)
    expect.truthy(ring[1]:mean_turn() < 12)
    local low = ball:cut{ path = ball:path{ points = points, closed = true }, seed = { 0, -1, 0 } }
    expect.truthy(low:bounds().min[2] < -0.9)
    local part, _, outline = ball:cut{ region = region, smoothing = 0.05 }
    expect.truthy(#part < #ball and outline[1]:mean_turn() < 12)
end)

test("a plane or path that keeps nearly all is told; a seed and a region name what they keep", function()
    local function ring_at(height, sign)
        local list, r = {}, math.sqrt(1 - height * height)
        for i = 1, 10 do
            local angle = sign * i * math.pi / 5
            list[i] = { r * math.cos(angle), height, r * math.sin(angle) }
        end
        return list
    end
    local down = { point = { 0, 0.8, 0 }, normal = { 0, -1, 0 } }
    for _, by in ipairs{ { path = ring_at(0.8, 1) }, { plane = down } } do
        local _, _, of_most = ball:cut(by)
        expect.near(of_most.report.kept_fraction, 0.9, 0.01)
        expect.equal(of_most.report.warnings[1].kind, "keeps_most")
        expect.truthy(of_most.report.warnings[1].message:find("the cut keeps %d+ %% of"))
    end
    for _, by in ipairs{ { region = most }, { path = ring_at(0.8, 1), seed = { 0, -1, 0 } },
        { plane = down, seed = { 0, -1, 0 } } } do
        local _, _, of_named = ball:cut(by)
        expect.equal(#of_named.report.warnings, 0)
        expect.near(of_named.report.kept_fraction, 0.9, 0.01)
    end
end)

test("a region with several outlines is cut along all, and that is told", function()
    local band = most:intersect(ball:region{ plane = { point = { 0, -0.5, 0 }, normal = { 0, 1, 0 } } })
    local _, _, of_band = ball:cut{ region = band }
    expect.equal(#of_band.report.warnings, 1)
    expect.equal(of_band.report.warnings[1].kind, "several_outlines")
    expect.truthy(of_band.report.warnings[1].message:find("2 outlines", 1, true))
    expect.truthy(of_band.report.warnings[1].message:find("1 piece kept, 2 pieces left", 1, true))
end)

test("a preview returns the lines and cuts nothing", function()
    local lines, nothing = cactus:cut{ plane = { point = arm_height, normal = { 0, 1, 0 } }, preview = true }
    expect.equal(cactus:hash(), hash)
    expect.equal(nothing, nil)
    expect.equal(#lines, 1)
    expect.equal(#lines.others, 2)
    expect.truthy(rawequal(lines[1]:mesh(), cactus) and lines[1]:is_closed() and not lines[1]:is_boundary())
    for _, p in ipairs(lines[1]:points()) do expect.near(p[2], arm_height[2], 1e-9) end
    expect.near(lines[1]:length(), loops[1]:length(), 0.02)
    expect.near(lines.report.kept_fraction, loops.report.kept_fraction, 1e-12)
    expect.equal(#lines[1]:vertices(), 0)
    expect.error(function() lines[1]:region() end, "points of its own")
    expect.error(function() lines[1]:smooth() end, "points of its own")
    expect.error(function() assert(cactus:copy():fill(lines[1])) end, "only an open boundary")
    local shown = torus:cut{ plane = { point = { 1, 0, 0 }, normal = { 0, 0, 1 } }, preview = true }
    expect.equal(shown.report.warnings[#shown.report.warnings].kind, "not_separating")
    expect.equal(#ball:cut{ path = points, preview = true }, 1)
    expect.equal(#ball:cut{ region = region, preview = true }, 1)
    expect.error(function() ball:cut{ region = region, preview = 1 } end, "preview")
end)

test("options that do not go together", function()
    expect.error(function() ball:cut{} end, "needs one of the options")
    expect.error(function() ball:cut{ path = points, region = region } end, "needs one of the options")
    expect.error(function()
        ball:cut{ plane = { point = { 0, 0, 0 }, normal = { 0, 1, 0 } }, smoothing = 0.04 }
    end, "smoothing")
    expect.error(function() ball:cut{ region = region, seed = { 0, 1, 0 } } end, "seed")
    expect.error(function() ball:cut{ region = region, slide = 0.9 } end, "slide")
end)

test("trimming changes the mesh in place", function()
    local jagged = ball:extract(region)
    local border = jagged:boundaries()[1]
    expect.truthy(border:mean_turn() > 20)
    local smooth, report = border:trim{}
    expect.truthy(rawequal(smooth:mesh(), jagged) and smooth:is_boundary())
    expect.truthy(report.before > 20 and report.after < 15 and report.removed_faces > 0)
    expect.near(smooth:mean_turn(), report.after, 1e-9)
    expect.error(function() border:trim() end, "[topology_mismatch]")
    local before = jagged:hash()
    expect.failure("boundary_conflict", smooth.trim, smooth, { margin = 1000 })
    expect.equal(jagged:hash(), before)
end)
