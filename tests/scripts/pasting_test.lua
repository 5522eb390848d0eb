-- Where parts find room, and what goes under them.
local lissom = require "lissom"

local function expect_whole(mesh, genus)
    expect.truthy(mesh:is_closed())
    expect.equal(mesh:components(), 1)
    expect.equal(mesh:genus(), genus or 0)
end

-- A ball whose vertices are lifted by `lift(x, y, z)` along the way from its centre.
local function lifted(segments, lift)
    local mesh = lissom.shapes.sphere{ segments = segments, kind = "triangles" }
    for i = 1, #mesh do
        local x, y, z = mesh:position(i)
        local s = 1 + lift(x, y, z)
        mesh:set_position(i, s * x, s * y, s * z)
    end
    return mesh
end

-- A bump of a width at a point of the ball.
local function bump(x, y, z, px, py, pz, height, width)
    local square = (x - px) ^ 2 + (y - py) ^ 2 + (z - pz) ^ 2
    return height * math.exp(-square / (width * width))
end

local function nosed(segments)
    return lifted(segments, function(x, y, z) return bump(x, y, z, 0, 0, 1, 0.35, 0.2) end)
end

local function nose_of(mesh)
    return { source = mesh, region = mesh:region{ sphere = { center = { 0, 0, 1.1 }, radius = 0.6 } } }
end

local function paste_nose(options)
    local nose = nose_of(options.source or nosed(40))
    nose.target, nose.placement, nose.clear = options.target, options.placement, options.clear
    local paste = assert(lissom.paste(nose))
    paste:optimize()
    return paste
end

test("clear: what goes lies under the part, and a mouth beside the nose stays", function()
    -- Below the nose a deep furrow and a ridge, within the part's reach of its place.
    local function mouth(x, y, z)
        local along = z > 0 and math.max(0, 1 - (x / 0.4) ^ 2) or 0
        return 0.08 * along * math.sin(14 * (y + 0.5)) * math.exp(-((y + 0.5) / 0.12) ^ 2)
    end
    local face = lifted(60, function(x, y, z) return bump(x, y, z, 0, 0, 1, 0.3, 0.18) + mouth(x, y, z) end)
    local paste = paste_nose{ target = face, clear = true,
        placement = { at = { 0, 0, 1.3 }, scale = 0.75, angle = 0 } }
    local gone, what = paste:clearing()
    expect.truthy(what.faces > 50 and what.area > 0.1)
    expect.near(what.height, 0.3, 0.08)
    local _, image = paste:loop()
    local radius = 0
    for _, p in ipairs(image:points()) do radius = math.max(radius, math.sqrt(p[1] ^ 2 + p[2] ^ 2)) end
    for _, v in ipairs(gone:vertices()) do
        local x, y = face:position(v)
        expect.truthy(math.sqrt(x * x + y * y) < 1.1 * radius)
    end
    local mesh, report = paste:merge()
    expect_whole(mesh)
    expect.equal(report.paste.clearing.faces, what.faces)
    -- Every vertex of the mouth beyond the loop is still there.
    local kept = 0
    for i = 1, #face do
        local x, y, z = face:position(i)
        if z > 0 and y < -1.25 * radius and y > -0.75 and math.abs(x) < 0.35 then
            expect.near(mesh:nearest(x, y, z).distance, 0, 1e-9)
            kept = kept + 1
        end
    end
    expect.truthy(kept > 20)
end)

test("clear: a small shift of the place decides nothing", function()
    local face = lifted(60, function(x, y, z)
        return bump(x, y, z, 0, 0, 1, 0.3, 0.18) + bump(x, y, z, 0, -0.55, 0.83, -0.1, 0.1)
    end)
    local areas = {}
    for _, shift in ipairs{ -0.003, 0, 0.003 } do
        local paste = paste_nose{ target = face, clear = true,
            placement = { at = { shift, 0, 1.3 }, scale = 0.6, angle = 0 } }
        local _, what = paste:clearing()
        areas[#areas + 1] = what.area
        local mesh = paste:merge()
        expect_whole(mesh)
        expect.near(mesh:nearest(0, -0.55 * 0.9, 0.83 * 0.9).distance, 0, 0.03)
    end
    expect.near(areas[1], areas[2], 0.1 * areas[2])
    expect.near(areas[3], areas[2], 0.1 * areas[2])
end)

test("clear: a part that clears nothing has nothing to show", function()
    local paste = paste_nose{ target = nosed(30), placement = { at = { 0, 1, 0 }, scale = 0.5 } }
    expect.equal(paste:clearing(), nil)
end)

test("erase takes nothing beyond the region and its ring, and nothing that it runs around", function()
    local ball = lifted(60, function(x, y, z) return bump(x, y, z, 0, 1, 0, 0.8, 0.25) end)
    -- A band around the horn: the tip is not marked.
    local band = ball:region{ box = { min = { -0.4, 1.15, -0.4 }, max = { 0.4, 1.4, 0.4 } } }
    expect.error(function() assert(ball:erase(band)) end, "runs around")
    for _, ring in ipairs{ 0.2, 0.5, 1 } do
        local marked = ball:region{ sphere = { center = { 0, 1.4, 0 }, radius = 0.62 } }
        local _, report = assert(ball:erase(marked, { ring = ring }))
        local near = {}
        local around = ball:region{ geodesic = { from = marked, radius = report.ring + 1e-9 } }
        for _, v in ipairs(around:vertices()) do near[v] = true end
        for _, v in ipairs(report.loop:vertices()) do expect.truthy(near[v] or marked:contains(v)) end
    end
    local exact = ball:region{ sphere = { center = { 0, 1.4, 0 }, radius = 0.62 } }
    local _, report = assert(ball:erase(exact, { ring = 0 }))
    expect.equal(report.removed_faces, #exact:faces())
end)

test("erase does not cross an edge of the target", function()
    local box = lissom.shapes.box{ segments = { 24, 24, 24 } }
    for i = 1, #box do
        local x, y, z = box:position(i)
        if z > 0.49 then
            box:set_position(i, x, y, z + 0.2 * math.exp(-((x - 0.3) ^ 2 + y * y) / 0.01))
        end
    end
    local marked = box:region{ sphere = { center = { 0.3, 0, 0.5 }, radius = 0.19 } }
    local plain, report = assert(box:erase(marked, { ring = 2 }))
    expect_whole(plain)
    for _, v in ipairs(report.loop:vertices()) do
        local x, _, z = box:position(v)
        expect.truthy(x < 0.5 + 1e-9 and z > 0.5 - 1e-9)
    end
end)

test("a part finds room on a cube of twelve triangles, and its edges are not bitten", function()
    for _, at in ipairs{ { 0.1, 0.1, 0.5 }, { 0.5, 0.1, 0.5 }, { 0.5, 0.5, 0.5 }, { -0.5, 0.2, -0.3 } } do
        for _, polygons in ipairs{ false, true } do
            local cube = lissom.shapes.box()
            if not polygons then cube:triangulate() end
            local paste = paste_nose{ target = cube, placement = { at = at, scale = 0.2 } }
            local mesh, report = paste:merge()
            expect_whole(mesh)
            expect.truthy(report.ok)
            local _, image = paste:loop()
            -- Away from the part the cube's edges are where they were.
            for _, axis in ipairs{ 1, 2, 3 } do
                for step = -10, 10 do
                    for _, corner in ipairs{ { 0.5, 0.5 }, { 0.5, -0.5 }, { -0.5, 0.5 }, { -0.5, -0.5 } } do
                        local p = { corner[1], corner[2] }
                        table.insert(p, axis, step / 20)
                        local near = math.huge
                        for _, q in ipairs(image:points()) do
                            near = math.min(near, (p[1] - q[1]) ^ 2 + (p[2] - q[2]) ^ 2 + (p[3] - q[3]) ^ 2)
                        end
                        local inside = (p[1] - at[1]) ^ 2 + (p[2] - at[2]) ^ 2 + (p[3] - at[3]) ^ 2 < 0.15 ^ 2
                        if near > 0.05 ^ 2 and not inside then
                            expect.near(mesh:nearest(p[1], p[2], p[3]).distance, 0, 1e-9)
                        end
                    end
                end
            end
        end
    end
end)

test("a part that is dragged over a coarse target finds room everywhere, whatever the way", function()
    local cube = lissom.shapes.box():triangulate()
    local paste = paste_nose{ target = cube, placement = { at = { 0, 0, 0.5 }, scale = 0.15 } }
    for step = 1, 8 do
        assert(paste:move{ at = { 0.06 * step, 0.03 * step, 0.5 }, search = false })
        expect.truthy(#assert(paste:draft()) > 50)
    end
    assert(paste:move{ at = { 0, 0, 0.5 } })
    local again = paste_nose{ target = cube, placement = { at = { 0, 0, 0.5 }, scale = 0.15 } }
    assert(again:move{ at = { 0, 0, 0.5 } })
    expect.equal(paste:merge():face_count(), again:merge():face_count())
end)

test("without a way the part's up is the target's, as far as the surface allows", function()
    local ball = lissom.shapes.sphere{ segments = 40, radius = 3, kind = "triangles" }
    local _, side = paste_nose{ target = ball, placement = { at = { 3, 0, 0 }, scale = 0.8 } }:merge()
    expect.equal(side.paste.upright, true)
    expect.equal(side.paste.angle_chosen, false)
    expect.near(side.paste.angle, 0, 1e-9)
    local _, top = paste_nose{ target = ball, placement = { at = { 0, 3, 0 }, scale = 0.8 } }:merge()
    expect.equal(top.paste.upright, false)
    expect.equal(top.paste.angle_chosen, true)
    local placement = { at = { 3, 0, 0 }, scale = 0.8, angle = 30 }
    local _, turned = paste_nose{ target = ball, placement = placement }:merge()
    expect.equal(turned.paste.upright, false)
end)

test("a feature that is sought takes the open boundaries around it", function()
    local mesh = nosed(40)
    local holed = mesh:remove(mesh:region{ sphere = { center = { 0.22, 0, 1.05 }, radius = 0.09 } })
    holed = holed:remove(holed:region{ sphere = { center = { -0.22, 0, 1.05 }, radius = 0.09 } })
    expect.equal(#holed:boundaries(), 2)
    local ball = lissom.shapes.sphere{ segments = 40, radius = 3, kind = "triangles" }
    local paste = paste_nose{ source = holed, target = ball, placement = { at = { 3, 0, 0 } } }
    local pasted = paste:merge()
    expect.equal(#pasted:boundaries(), 2)
    expect.equal(pasted:components(), 1)
end)

test("scatter: parts that would cross are made smaller, or left out, or counted", function()
    -- Mushrooms: their caps are much wider than their stems.
    local cap = lifted(40, function(x, y, z) return bump(x, y, z, 0, 1, 0, 1.2, 0.25) end)
    for i = 1, #cap do
        local x, y, z = cap:position(i)
        if y > 1.5 then
            local wide = 1 + 9 * math.min(1, (y - 1.5) / 0.3)
            cap:set_position(i, wide * x, y, wide * z)
        end
    end
    local ball = lissom.shapes.sphere{ segments = 60, radius = 3, kind = "triangles" }
    local function scattered(crossings, gap)
        return lissom.scatter{ source = cap, target = ball, crossings = crossings, scales = { 0.6 },
            region = cap:region{ box = { min = { -9, 0.7, -9 }, max = { 9, 9, 9 } } },
            feature = cap:region{ box = { min = { -9, 1.15, -9 }, max = { 9, 9, 9 } } },
            at = { { 0, 0, 3 }, { gap, 0, 3 } } }
    end
    local _, kept = scattered("keep", 1.3)
    expect.equal(#kept.refused, 0)
    expect.truthy(kept.crossings > 0)
    local out, left = scattered("leave out", 1.3)
    expect.equal(#left.refused, 1)
    expect.equal(left.refused[1].place, 2)
    expect.truthy(left.refused[1].message:find("place 1"))
    expect.equal(#out:self_intersections(), 0)
    local small, shrunk = scattered("shrink", 1.3)
    expect.equal(#shrunk.refused + #shrunk.shrunk, 1)
    expect.equal(#small:self_intersections(), 0)
    local _, apart = scattered("shrink", 9)
    expect.equal(#apart.refused + #apart.shrunk + apart.crossings, 0)
end)

test("scatter: there is room on a cube of twelve triangles", function()
    local nose = nose_of(nosed(30))
    nose.target, nose.scales = lissom.shapes.box():triangulate(), { 0.08 }
    nose.at = { { 0.2, 0.2, 0.5 }, { -0.2, -0.2, 0.5 }, { 0.5, 0, 0 }, { 0, -0.5, 0.1 }, { 0.5, 0.3, 0.5 } }
    local mesh, report = lissom.scatter(nose)
    expect.equal(#report.refused, 0)
    expect_whole(mesh)
end)
