local lissom = require "lissom"

local function ball(segments) return lissom.shapes.sphere{ kind = "triangles", segments = segments or 12 } end

local function half(mesh, height, normal)
    return (mesh:cut{ plane = { point = { 0, height or 0, 0 }, normal = normal or { 0, 1, 0 } } })
end
local cap = half(ball())
local bowl = half(ball(), 0.1):transform{
    rotate = { axis = "x", angle = 180 }, scale = 3, translate = { 5, 1, 2 },
}

local function rim(mesh) return mesh:boundaries()[1] end

local function join(keys) return { source = rim(cap), target = rim(bowl), keys = keys } end

local function extreme(boundary, axis)
    local best, points = 1, boundary:points()
    for i, p in ipairs(points) do
        if p[axis] > points[best][axis] then best = i end
    end
    return boundary:vertices()[best]
end
local from, to = extreme(rim(cap), 1), extreme(rim(bowl), 1)
local cap_hash, bowl_hash = cap:hash(), bowl:hash()
local mesh, report = lissom.merge{ source = cap, target = bowl, joins = { join{ { from, to } } } }

local function same(a, b, tolerance)
    expect.equal(#a, #b)
    local p, q = a:positions(), b:positions()
    for i = 1, #p do
        if not (math.abs(p[i] - q[i]) <= tolerance) then
            error("vertices " .. math.ceil(i / 3) .. " are " .. math.abs(p[i] - q[i]) .. " apart", 2)
        end
    end
end
local tube = lissom.shapes.cylinder{ radius = 0.5, height = 2, segments = 24, rings = 12, caps = false }
local ends = tube:boundaries()
local low = half(ball(), -0.5, { 0, -1, 0 }):transform{ translate = { 0, 3, 0 } }
local high = half(ball(), 0.6):transform{ translate = { 3, 5, 0 } }

local function fails(code, kind, action)
    local elements = expect.failure(code, action).elements
    if kind then expect.truthy(elements and elements.kind == kind and #elements.ids > 0) end
    expect.equal(cap:hash(), cap_hash)
    expect.equal(bowl:hash(), bowl_hash)
end

local function merging_fails(code, kind, joins, options)
    fails(code, kind, function()
        local all = { joins = joins }
        for key, value in pairs(options or {}) do all[key] = value end
        return lissom.merge(all)
    end)
end

test("what comes back", function()
    expect.truthy(mesh:is_closed() and mesh:is_manifold())
    expect.equal(mesh:genus(), 0)
    expect.equal(mesh:components(), 1)
    expect.equal(cap:hash(), cap_hash)
    expect.equal(bowl:hash(), bowl_hash)
    expect.near(report.joins[1].scale, 3, 0.1)
    expect.equal(report.joins[1].guessed, false)
    expect.equal(report.joins[1].certainty, nil)
    expect.equal(report.joins[1].source_size, #rim(cap))
    expect.equal(report.joins[1].target_size, #rim(bowl))
    expect.truthy(report.joins[1].source_turn < 20 and not report.joins[1].source_trimmed)
    expect.equal(#report.warnings, 0)
    expect.truthy(not report.flipped.source and #report.flipped.targets == 0)
    expect.truthy(report.free_vertices > 100 and report.displaced_vertices >= 0)
    expect.truthy(report.prepare_seconds >= 0 and report.solve_seconds >= 0)
    expect.truthy(report.first_factor_seconds >= 0 and report.second_factor_seconds >= 0)
    expect.truthy(report.seam.after.max_dihedral < 25 and report.seam.after.rms_dihedral < 15)
    expect.truthy(report.seam.before.max_dihedral > 0)
    expect.truthy(report.seam.after.max_near >= report.seam.after.max_dihedral - 1e-9)
    expect.equal(#mesh:self_intersections(), 0)
end)

test("regions and seams are those of the merged mesh, and say which side a vertex is on", function()
    expect.truthy(rawequal(report.seams[1]:mesh(), mesh) and report.seams[1]:is_closed())
    expect.equal(#report.source + #report.target, #mesh + #report.seams[1])
    for _, v in ipairs(report.seams[1]:vertices()) do
        expect.truthy(report.source:contains(v) and report.target:contains(v))
    end
    expect.truthy(report.target:contains(1))
end)

test("provenance: elements off the seam come from one element, with their order", function()
    -- Provenance: elements off the seam come from one element, with their order; weights sum to 1.
    local sides = { source = 0, target = 0 }
    for v = 1, #mesh do
        local sum, origins = 0, report.provenance:vertex(v)
        for _, origin in ipairs(origins) do
            sum = sum + origin.weight
            expect.truthy(origin.vertex >= 1 and origin.vertex <= (origin.side == "source" and #cap or #bowl))
            expect.equal(origin.target, origin.side == "target" and 1 or nil)
        end
        expect.near(sum, 1, 1e-12)
        if #origins == 1 then sides[origins[1].side] = sides[origins[1].side] + 1 end
    end
    expect.truthy(sides.source > 0.8 * #cap and sides.target > 0.8 * #bowl)
    local face = report.provenance:face(mesh:face_count())[1]
    expect.truthy(face.side == "source" and face.face >= 1 and face.face <= cap:face_count())
    expect.error(function() report.provenance:vertex(#mesh + 1) end, "[out_of_range]")
end)

test("keys are ids or points, in any number; both name the same place", function()
    local by_points = lissom.merge{ joins = { join{ { { cap:position(from) }, { bowl:position(to) } } } } }
    same(by_points, mesh, 1e-9)
    local mixed = lissom.merge{ joins = { join{ { from, { bowl:position(to) } } } } }
    same(mixed, mesh, 1e-9)
    local _, guessed = lissom.merge{ joins = { join() } }
    expect.equal(guessed.joins[1].placed, "as placed")
    expect.equal(guessed.joins[1].guessed, false)
    expect.near(guessed.joins[1].turn.angle, 0, 0.1)
    local _, by_shape = lissom.merge{ joins = { join() }, place = "shape" }
    expect.equal(by_shape.joins[1].placed, "shape")
    expect.truthy(by_shape.joins[1].guessed and by_shape.joins[1].certainty <= 1)
    expect.truthy(by_shape.joins[1].certainty > 0.75 or #by_shape.warnings > 0)
    -- The key of a report makes the same result.
    local confirmed = lissom.merge{ joins = { join{ by_shape.joins[1].key } } }
    same(confirmed, lissom.merge{ joins = { join() }, place = "shape" }, 1e-9)
    expect.error(function()
        lissom.merge{ joins = { join() }, place = "shape", configuration = "fixed" }
    end, "invalid_argument")
    expect.error(function() lissom.merge{ joins = { join() }, place = "by shape" } end, "as placed")
end)

test("wherever the source lies", function()
    local moved = cap:copy():transform{
        scale = 100, rotate = { axis = { 1, 2, 3 }, angle = 77 }, translate = { -4000, 900, 77 },
    }
    local elsewhere = lissom.merge{
        joins = { { source = rim(moved), target = rim(bowl), keys = { { from, to } } } },
    }
    same(elsewhere, mesh, 1e-9 * mesh:size())
end)

test("without smoothing and collars the target stays to the bit", function()
    local sharp, sharp_report = lissom.merge{ smooth = 0, collar = false, joins = { join{ { from, to } } } }
    expect.equal(sharp_report.seam.collar_added, 0)
    for v = 1, #sharp do
        local origins = sharp_report.provenance:vertex(v)
        if #origins == 1 and origins[1].side == "target" then
            local x, y, z = sharp:position(v)
            local a, b, c = bowl:position(origins[1].vertex)
            expect.truthy(x == a and y == b and z == c)
        end
    end
end)

test("every option is taken, and every way to sew closes the seam", function()
    for _, seam in ipairs{ "conform", "fair", "band" } do
        local sewn, of_seam = lissom.merge{ seam = seam, joins = { join{ { from, to } } } }
        expect.truthy(sewn:is_closed() and sewn:is_manifold())
        expect.equal(of_seam.seam.band_removed > 0, seam == "band")
    end
    for _, options in ipairs{
        { transition = { source = 0.3, target = 0.9 } },
        { subdivide = false }, { trim = false }, { collar = false },
        { max_turn = 5 }, { fidelity = "thesis" }, { fidelity = "default", smooth = 10 },
    } do
        options.joins = { join{ { from, to } } }
        expect.truthy(lissom.merge(options):is_closed())
    end
end)

test("fidelity: section 3.3 to the letter, and options that are given count before it", function()
    local function report_of(options)
        options.joins = { join{ { from, to } } }
        local sewn, literal = lissom.merge(options)
        expect.truthy(sewn:is_closed())
        return literal, sewn
    end
    local literal = report_of{ fidelity = "thesis" }
    expect.truthy(literal.seam.band_removed > 0)
    expect.equal(literal.seam.flipped, 0)
    expect.equal(literal.seam.smoothed, 3)
    for _, name in ipairs{ "first_solve_seconds", "polar_seconds", "second_solve_seconds" } do
        expect.truthy(literal[name] >= 0, name)
    end
    local asked = report_of{ fidelity = "thesis", seam = "conform", smooth = 1, trim = true,
        subdivide = true }
    expect.equal(asked.seam.band_removed, 0)
    expect.truthy(asked.seam.inserted_into_target > 0)
    expect.equal(asked.seam.smoothed, 1)
    -- With a transition seams are not smoothed, and the target's region gives way to the source's.
    local faded, overlapped = report_of{ fidelity = "thesis", transition = { source = 0.5, target = 1.5 } }
    expect.equal(faded.seam.smoothed, 0)
    expect.truthy(#faded.target < 0.9 * #bowl)
    expect.truthy(faded.transition[1].source.vertices > 20 and overlapped:genus() == 0)
end)

test("a sparse side gets a collar: no slivers at the seam, and nothing worse than it was", function()
    local dense = half(lissom.shapes.sphere{ segments = 96 }, 0.1)
    local coarse = half(lissom.shapes.sphere{ segments = 12 }, 0.1)
    local function sewn(collar)
        return lissom.merge{ collar = collar, joins = { { source = rim(dense), target = rim(coarse) } } }
    end
    local fine, of_fine = sewn()
    local plain, of_plain = sewn(false)
    expect.truthy(fine:is_closed() and plain:is_closed())
    expect.truthy(of_fine.seam.collar_added > of_fine.seam.collar_removed and of_fine.seam.collar_removed > 0)
    expect.equal(of_plain.seam.collar_added, 0)
    expect.truthy(of_fine.seam.after.smallest_angle > 12 and of_plain.seam.after.smallest_angle < 10)
    for _, of_seam in ipairs{ of_fine.seam, of_plain.seam } do
        expect.truthy(of_seam.after.max_dihedral <= of_seam.before.max_dihedral + 1e-4)
        expect.truthy(of_seam.after.max_near <= of_seam.before.max_near + 1e-4)
    end
end)

test("fixed: the source stays but near its boundary, or but for what is not held", function()
    local near = half(ball(), 0.1):transform{
        rotate = { axis = "x", angle = 180 }, translate = { 0, -0.1, 0 },
    }
    local function fixed(options)
        options.configuration = "fixed"
        local key = { from, extreme(rim(near), 1) }
        options.joins = { { source = rim(cap), target = rim(near), keys = { key } } }
        return lissom.merge(options)
    end
    local top = cap:region{ plane = { point = { 0, 0.7, 0 }, normal = { 0, 1, 0 } } }
    local function expect_held(result, of_result)
        local held = 0
        for v = 1, #result do
            local origins = of_result.provenance:vertex(v)
            if #origins == 1 and origins[1].side == "source" and top:contains(origins[1].vertex) then
                local x, y, z = result:position(v)
                local a, b, c = cap:position(origins[1].vertex)
                expect.truthy(x == a and y == b and z == c)
                held = held + 1
            end
        end
        expect.equal(held, #top)
    end
    expect_held(fixed{ fixed = { top } })
    expect_held(fixed{ reach = 0.4 })
    expect_held(fixed{ reach = 0.4, frames = "keep" })
    -- In the free configuration what is fixed moves as a whole.
    local whole, of_whole = lissom.merge{ fixed = { top }, joins = { join{ { from, to } } } }
    expect.truthy(whole:is_closed())
    local ratios = {}
    for v = 1, #whole do
        local origins = of_whole.provenance:vertex(v)
        if #origins == 1 and origins[1].side == "source" and top:contains(origins[1].vertex) then
            table.insert(ratios, { { whole:position(v) }, { cap:position(origins[1].vertex) } })
        end
    end
    local function distance(a, b)
        return math.sqrt((a[1] - b[1]) ^ 2 + (a[2] - b[2]) ^ 2 + (a[3] - b[3]) ^ 2)
    end
    local scale = distance(ratios[1][1], ratios[#ratios][1]) / distance(ratios[1][2], ratios[#ratios][2])
    for i = 2, #ratios do
        expect.near(distance(ratios[1][1], ratios[i][1]) / distance(ratios[1][2], ratios[i][2]), scale, 1e-6)
    end
end)

test("several joins, on several targets", function()
    local bottom_first = ends[1]:points()[1][2] < 0
    local bottom, upper = ends[bottom_first and 1 or 2], ends[bottom_first and 2 or 1]
    local chain, of_chain = lissom.merge{ source = tube, target = { low, high }, joins = {
        { source = bottom, target = rim(low), keys = { { extreme(bottom, 1), extreme(rim(low), 1) } } },
        { source = upper, target = rim(high), keys = { { extreme(upper, 1), extreme(rim(high), 1) } } },
    } }
    expect.truthy(chain:is_closed())
    expect.equal(chain:components(), 1)
    expect.equal(#of_chain.joins, 2)
    expect.equal(#of_chain.seams, 2)
    expect.equal(of_chain.provenance:vertex(#low)[1].side, "target")
    -- On one target: a handle.
    local holed = half(ball(), -0.8):copy()
    holed = half(holed, 0.8, { 0, -1, 0 })
    local rims = holed:boundaries()
    local handle, of_handle = lissom.merge{ joins = {
        { source = ends[1], target = rims[1] }, { source = ends[2], target = rims[2] },
    } }
    expect.truthy(handle:is_closed())
    expect.equal(handle:genus(), 1)
    expect.equal(of_handle.joins[1].placed, "as placed")
end)

test("solved again after a key moved", function()
    local merger = lissom.merger{ joins = { join{ { from, to } } } }
    same(merger:solve(), mesh, 0)
    local other = rim(bowl):vertices()[5]
    merger:set_keys(1, { { from, other } })
    local turned = merger:solve()
    same(turned, lissom.merge{ joins = { join{ { from, other } } } }, 1e-9)
    expect.error(function() merger:set_keys(2, {}) end, "[out_of_range]")
    expect.error(function() merger:set_keys(1, { { from } }) end, "keys")
    -- Keys are checked when they are set; those of before stay.
    expect.failure("key_conflict", merger.set_keys, merger, 1, { { #cap + 1, other } })
    same(merger:solve(), turned, 0)
    merger:close()
    expect.error(function() merger:solve() end, "closed")
end)

test("directions that belong together decide where round rims meet, and one without the", function()
    -- Directions that belong together decide where round rims meet, and one without the other is refused.
    local around = lissom.shapes.cylinder{ radius = 1, height = 2, segments = 40, rings = 8, caps = false }
    local ring_of = around:boundaries()[1]
    for _, front in ipairs{ "z", "-x", { 1, 0, 1 } } do
        local fitted, of_fitted = lissom.merge{ joins = { { source = rim(cap), target = ring_of } },
            source_front = front, target_front = "z" }
        expect.truthy(fitted and not of_fitted.joins[1].guessed)
        expect.equal(of_fitted.joins[1].placed, "directions")
        local d = front == "z" and { 0, 0, 1 } or front == "-x" and { -1, 0, 0 } or
            { 0.70710678, 0, 0.70710678 }
        -- What lies at the front of the cap's rim comes to lie at the front of the cylinder's.
        for v = 1, #fitted do
            local origins = of_fitted.provenance:vertex(v)
            if #origins == 1 and origins[1].side == "source" then
                local x, _, z = cap:position(origins[1].vertex)
                local r = math.sqrt(x * x + z * z)
                if r > 0.5 and (x * d[1] + z * d[3]) / r > 0.999 then
                    local a, _, c = fitted:position(v)
                    expect.truthy(c / math.sqrt(a * a + c * c) > 0.99)
                end
            end
        end
    end
    expect.error(function()
        lissom.merge{ joins = { join() }, source_front = "z" }
    end, "directions come in pairs")
    expect.error(function()
        lissom.merge{ joins = { join() }, source_up = "north", target_up = "y" }
    end, "source_up")
end)

test("the verdict", function()
    expect.truthy(report.ok and report.verdict:find("^good: "))
    expect.equal(#report.reasons, 0)
    expect.equal(tostring(report), report.verdict)
    local band = report.joins[1].band
    expect.truthy(band.roughness > 0 and band.rest_roughness > 0 and band.source_volume > 0.75)
    local _, of_folded = lissom.merge{ joins = { join{ { from, to } } }, smooth = 0, intersections = false }
    expect.truthy(of_folded.verdict:find("were not looked for", 1, true) or not of_folded.ok)
end)

test("a verdict names each fault with its figure, its limit and what may help", function()
    -- Between loops of 6 and 400 vertices there are slivers, which collars take away.
    local function open_tube(segments, rings)
        return lissom.shapes.cylinder{ height = 2, segments = segments, rings = rings, caps = false }
    end
    local coarse, dense = open_tube(6, 6), open_tube(400, 20)
    local function joined(collar)
        return select(2, lissom.merge{ smooth = 0, collar = collar, joins = { { source = rim(coarse),
            target = rim(dense), keys = { { extreme(rim(coarse), 1), extreme(rim(dense), 1) } } } } })
    end
    local function slivers_of(of)
        for _, reason in ipairs(of.reasons) do
            if reason.fault == "slivers" then return reason end
        end
    end
    expect.equal(slivers_of(joined(true)), nil)
    local of_slivers = joined(false)
    local reason = slivers_of(of_slivers)
    expect.truthy(not of_slivers.ok and reason)
    expect.truthy(reason.value < reason.limit and reason.limit <= 2)
    expect.truthy(of_slivers.verdict:find(reason.text, 1, true) and reason.remedy:find("collar"))
    expect.equal(tostring(reason), reason.text .. "; " .. reason.remedy)
    expect.truthy(tostring(of_slivers):find(of_slivers.verdict .. "\n", 1, true) == 1)
    expect.truthy(tostring(of_slivers):find("\n  slivers: " .. reason.remedy, 1, true))
end)

test("loose parts are told", function()
    local with_eye = cap:copy():append(ball(2):transform{ scale = 0.1, translate = { 0.3, 0.8, 0 } })
    local _, of_eye = lissom.merge{
        joins = { { source = rim(with_eye), target = rim(bowl), keys = { { from, to } } } },
    }
    expect.equal(of_eye.loose_parts, 1)
    expect.truthy(of_eye.warnings[1]:find("1 part of the source", 1, true))
end)

test("transitions: widths that suit, and those that have no room", function()
    local suited, of_suited = lissom.merge{ joins = { join{ { from, to } } }, transition = true }
    expect.truthy(suited:is_closed() and of_suited.transition[1].source.width > 0.5)
    expect.equal(#of_suited.warnings, 0)
    local _, of_wide = lissom.merge{
        joins = { join{ { from, to } } }, transition = { source = 100, target = 0.5 },
    }
    expect.equal(#of_wide.warnings, 1)
    expect.truthy(of_wide.warnings[1]:find("in place of 29", 1, true))
    expect.truthy(of_suited.transition_kept > 0.9)
    -- One that would fold the surface is left out, and that is said.
    local function bent_tube(segments, bend)
        local bent = lissom.shapes.cylinder{ height = 2, segments = segments, rings = 6, caps = false }
        for v = 1, #bent do
            local x, y, z = bent:position(v)
            bent:set_position(v, x + bend * math.sin(2 * y), y, z)
        end
        return bent
    end
    local refused = { source = rim(bent_tube(3, 0)), target = rim(bent_tube(40, 0.5)) }
    local _, of_refused = lissom.merge{ collar = false, transition = { source = 1.5, target = 1.5 },
        joins = { refused } }
    expect.equal(of_refused.transition_kept, 0)
    expect.truthy(table.concat(of_refused.warnings, "\n"):find("the transition was left out", 1, true))
    -- Behind a spike the lines away from the seam meet: the transition is left out, which is told.
    local function spiked_tube(spike)
        local pipe = lissom.shapes.cylinder{ height = 4, segments = 40, rings = 30, caps = false }
        for v = 1, #pipe do
            local x, y, z = pipe:position(v)
            local k = 1 + spike * math.exp(-(z * z + (y - 1.2) ^ 2) / 0.06)
            if x > 0 then pipe:set_position(v, x * k, y, z * k) end
        end
        return pipe
    end
    local function end_of(pipe, sign)
        for _, boundary in ipairs(pipe:boundaries()) do
            if boundary:points()[1][2] * sign > 0 then return boundary end
        end
    end
    for spike, folded in pairs{ [0] = false, [6] = true } do
        local _, of_spike = lissom.merge{
            joins = { { source = end_of(spiked_tube(0), -1), target = end_of(spiked_tube(spike), 1) } },
            transition = { target = 1.6 },
        }
        local told = table.concat(of_spike.warnings, "\n")
        expect.equal(told:find("would have folded the surface", 1, true) ~= nil, folded)
        expect.equal(of_spike.transition_kept, folded and 0 or 1)
    end
    local without, of_without = lissom.merge{ joins = { join{ { from, to } } }, transition = false }
    same(without, mesh, 0)
    expect.equal(#of_without.transition, 0)
    expect.equal(of_without.transition_kept, nil)
    expect.error(function()
        lissom.merge{ joins = { join() }, transition = 3 }
    end, "table of options or true expected")
end)

test("inside out is turned over, jagged is trimmed, and both are said", function()
    local inside_out = cap:copy():flip()
    local flipped, of_flipped = lissom.merge{ joins = { { source = rim(inside_out), target = rim(bowl) } } }
    expect.truthy(flipped:is_closed() and of_flipped.flipped.source and #of_flipped.warnings > 0)
    expect.truthy(flipped:volume() > 0)
    local ball_mesh = ball()
    local above = ball_mesh:region{ plane = { point = { 0, 0.2, 0 }, normal = { 0.3, 1, 0 } } }
    local toothed = ball_mesh:extract(above)
    local trimmed, of_trimmed = lissom.merge{ joins = { { source = rim(toothed), target = rim(bowl) } } }
    expect.truthy(trimmed:is_closed() and of_trimmed.joins[1].source_trimmed)
    expect.truthy(of_trimmed.joins[1].source_turn > 20)
end)

test("attributes, groups, materials, regions and skins come along", function()
    local function dressed(mesh_of, hue, name)
        local uv = mesh_of:add_attribute{ name = "uv", domain = "vertex", width = 2 }
        local color = mesh_of:add_attribute{ name = "color", domain = "vertex", width = 4 }
        local heat = mesh_of:add_attribute{ name = "heat", domain = "face", type = "float64" }
        local joints = mesh_of:add_attribute{ name = "joints", domain = "vertex", width = 4, type = "uint16" }
        local weights = mesh_of:add_attribute{ name = "weights", domain = "vertex", width = 4 }
        for v = 1, #mesh_of do
            local x, y = mesh_of:position(v)
            uv[2 * v - 1], uv[2 * v] = x, y
            for k = 1, 4 do color[4 * v - 4 + k] = k == 4 and 1 or hue end
            joints[4 * v - 3], joints[4 * v - 2] = 0, 1
            local w = math.max(0, math.min(1, 0.5 + x / 4))
            weights[4 * v - 3], weights[4 * v - 2] = w, 1 - w
        end
        for f = 1, mesh_of:face_count() do heat[f] = hue end
        return mesh_of:set_region(name, mesh_of:region{ all = true })
    end
    local warm, cold = dressed(cap:copy(), 0.75, "upper"), dressed(bowl:copy(), 0.25, "lower")
    local both, of_both = lissom.merge{ smooth = 0,
        joins = { { source = rim(warm), target = rim(cold), keys = { { from, to } } } } }
    local color, heat = both:attribute("color"), both:attribute("heat")
    local weights, uv = both:attribute("weights"), both:attribute("uv")
    for v = 1, #both do
        local origins = of_both.provenance:vertex(v)
        local wanted, sum = 0, 0
        for _, origin in ipairs(origins) do
            wanted = wanted + origin.weight * (origin.side == "source" and 0.75 or 0.25)
        end
        expect.near(color[4 * v - 3], wanted, 1e-6)
        for k = 1, 4 do sum = sum + weights[4 * v - 4 + k] end
        expect.near(sum, 1, 1e-6)
        if #origins == 1 then
            local mesh_of = origins[1].side == "source" and warm or cold
            expect.equal(weights[4 * v - 3], mesh_of:attribute("weights")[4 * origins[1].vertex - 3])
            expect.truthy(both:region(origins[1].side == "source" and "upper" or "lower"):contains(v))
            expect.truthy(not both:region(origins[1].side == "source" and "lower" or "upper"):contains(v))
        end
    end
    -- Along the seam both parts keep their own texture coordinates: these are of corners now.
    local corners = 0
    for f = 1, both:face_count() do
        for _, v in ipairs(both:face(f)) do
            corners = corners + 1
            local origins = of_both.provenance:vertex(v)
            if #origins == 1 then
                local mesh_of = origins[1].side == "source" and warm or cold
                expect.equal(uv[2 * corners], mesh_of:attribute("uv")[2 * origins[1].vertex])
            end
        end
        expect.equal(heat[f], of_both.provenance:face(f)[1].side == "source" and 0.75 or 0.25)
    end
end)

test("groups and materials, as files give them", function()
    local function grouped(mesh_of, group, material)
        local path = os.tmpname() .. ".obj"
        local file = assert(io.open(path, "w"))
        for v = 1, #mesh_of do
            file:write(string.format("v %.17g %.17g %.17g\n", mesh_of:position(v)))
        end
        file:write("g ", group, "\nusemtl ", material, "\n")
        for _, face_of in ipairs(mesh_of:faces()) do file:write("f ", table.concat(face_of, " "), "\n") end
        file:close()
        local loaded = assert(lissom.load(path))
        os.remove(path)
        return loaded
    end
    local hat, pot = grouped(cap, "hat", "felt"), grouped(bowl, "pot", "clay")
    local labelled = lissom.merge{ joins = { { source = rim(hat), target = rim(pot) } } }
    for _, label in ipairs{
        { group = "hat" }, { group = "pot" }, { material = "felt" }, { material = "clay" },
    } do
        local part = labelled:region(label)
        expect.truthy(#part > 50 and #part < #labelled)
    end
end)

test("misuse is an error that names what is wrong", function()
    expect.error(function() lissom.merge{} end, "joins")
    expect.error(function() lissom.merge{ joins = {} } end, "joins")
    expect.error(function() lissom.merge{ joins = { { source = rim(cap) } } } end, "list of joins expected")
    expect.error(function()
        lissom.merge{ joins = { { source = rim(cap), target = rim(bowl), key = {} } } }
    end, "did you mean 'keys'")
    expect.error(function() lissom.merge{ joins = { join{ { from } } } } end, "keys are pairs")
    expect.error(function() lissom.merge{ joins = { join{ { from, { 1, 2 } } } } } end, "keys are pairs")
    expect.error(function() lissom.merge{ joins = { join() }, smoth = 3 } end, "smooth")
    expect.error(function() lissom.merge{ joins = { join() }, seam = "glue" } end, "fair")
    expect.error(function()
        lissom.merge{ joins = { join() }, transition = { sauce = 1 } }
    end, "transition.sauce")
    expect.error(function() lissom.merge{ source = bowl, joins = { join() } } end, "source")
    expect.error(function() lissom.merge{ target = { bowl, low }, joins = { join() } } end, "target")
end)

test("paths that are no boundaries", function()
    local open = cap:path{ points = { rim(cap):vertices()[1], rim(cap):vertices()[9] } }
    merging_fails("not_a_boundary", "vertex", { { source = open, target = rim(bowl) } })
    local inner = cap:path{ points = { { 0.5, 0.8, 0 }, { 0, 0.8, 0.5 }, { -0.5, 0.8, 0 } }, closed = true }
    merging_fails("not_a_boundary", "vertex", { { source = inner, target = rim(bowl) } })
    local old = half(ball())
    local stale = rim(old)
    old:fill(stale)
    merging_fails("topology_mismatch", nil, { { source = stale, target = rim(bowl) } })
end)

test("a mesh merged with itself: two of its boundaries are joined, and nothing moves", function()
    local pair = tube:copy():append(tube:copy():transform{ translate = { 0, 3, 0 } })
    local before, rims = pair:hash(), pair:boundaries()
    local middle = { source = rims[3], target = rims[2] }
    local one, of_one = lissom.merge{ source = pair, target = pair, joins = { middle } }
    expect.equal(one:components(), 1)
    expect.equal(#one:boundaries(), 2)
    expect.equal(one:face_count(), pair:face_count() + 48)
    expect.truthy(of_one.ok)
    expect.equal(#of_one.joins, 1)
    for i = 1, #pair do
        local x, y, z = pair:position(i)
        local u, v, w = one:position(i)
        expect.truthy(x == u and y == v and z == w)
    end
    local ring, of_ring = lissom.merge{ joins = { middle, { source = rims[1], target = rims[4] } } }
    expect.truthy(ring:is_closed())
    expect.equal(ring:genus(), 1)
    expect.equal(#of_ring.joins, 2)
    local function refused(code, options)
        options.joins = options.joins or { middle }
        if code == "invalid_argument" then
            expect.error(function() lissom.merge(options) end, "[" .. code .. "]")
        else
            expect.failure(code, lissom.merge, options)
        end
    end
    refused("invalid_argument", { smooth = 0 })
    refused("invalid_argument", { configuration = "fixed" })
    refused("invalid_argument", { place = "shape" })
    refused("invalid_argument", { fidelity = "thesis" })
    refused("invalid_argument", { joins = { { source = rims[3], target = rims[2], keys = {
        { rims[3]:vertices()[1], rims[2]:vertices()[1] } } } } })
    refused("boundary_conflict", { joins = { { source = rims[1], target = rims[2] }, middle } })
    expect.equal(pair:hash(), before)
end)

test("a side without colors or texture coordinates has some after a merge, and a warning names it", function()
    local function holds_nan(place)
        local file = assert(io.open(place, "rb"))
        local text = file:read("*a"):lower()
        file:close()
        return text:find("%f[%a]nan%f[%A]") ~= nil
    end
    for _, of_cap in ipairs{ true, false } do
        local part, other = cap:copy(), bowl:copy()
        local painted = of_cap and part or other
        painted:parameterize{ attribute = "uv" }
        local joined = { source = rim(part), target = rim(other), keys = { { from, to } } }
        local both, of_both = lissom.merge{ joins = { joined } }
        expect.truthy(of_both.warnings[1]:find((of_cap and "the target" or "the source")
            .. " has no texture coordinates", 1, true))
        local values = both:attribute("uv")
        for i = 1, #values do expect.truthy(values[i] == values[i]) end
        for _, extension in ipairs{ ".obj", ".ply", ".glb" } do
            local place = os.tmpname() .. extension
            both:save(place, extension == ".ply" and { binary = false } or nil)
            if extension ~= ".glb" then expect.truthy(not holds_nan(place)) end
            expect.equal(lissom.load(place):face_count(), both:face_count())
            os.remove(place)
        end
    end
end)

test("joins that get in each other's way", function()
    merging_fails("boundary_conflict", nil, { { source = rim(cap), target = rim(cap) } })
    merging_fails("boundary_conflict", nil, { join(), join() })
    merging_fails("boundary_conflict", nil, {
        { source = ends[1], target = rim(bowl) }, { source = ends[2], target = rim(bowl) },
    })
    merging_fails("invalid_argument", nil, {
        { source = rim(cap), target = rim(bowl) }, { source = ends[1], target = rim(high) },
    })
end)

test("keys", function()
    local inside
    for v = 1, #cap do
        local _, y = cap:position(v)
        if y > 0.9 then inside = v end
    end
    merging_fails("key_conflict", "vertex", { join{ { inside, to } } })
    merging_fails("key_conflict", nil, { join{ { #cap + 1, to } } })
    local s, t = rim(cap):vertices(), rim(bowl):vertices()
    merging_fails("key_conflict", nil, { join{ { s[1], t[1] }, { s[1], t[9] } } })
    -- The source's loop runs against the target's.
    local m, n = #s, #t
    local third, two_thirds = math.floor(m / 3), math.floor(2 * m / 3)
    merging_fails("key_conflict", nil, { join{
        { s[1], t[1] }, { s[third], t[math.floor(n / 3)] }, { s[two_thirds], t[math.floor(2 * n / 3)] },
    } })
    local ordered = lissom.merge{ joins = { join{
        { s[1], t[1] }, { s[third], t[math.floor(2 * n / 3)] }, { s[two_thirds], t[math.floor(n / 3)] },
    } } }
    expect.truthy(ordered:is_closed())
end)

test("what is fixed", function()
    merging_fails("handle_overlap", "vertex", { join() }, { fixed = { cap:region{ all = true } } })
    merging_fails("handle_overlap", "vertex", { join() },
        { fixed = { rim(cap):region() }, configuration = "fixed" })
end)

test("skins whose joints have no names are of the same ones", function()
    local function skinned(mesh_of, joint)
        local copy = mesh_of:copy()
        local joints = copy:add_attribute{ name = "joints", domain = "vertex", width = 4, type = "uint16" }
        local values = copy:add_attribute{ name = "weights", domain = "vertex", width = 4 }
        for v = 1, #copy do joints[4 * v - 3], values[4 * v - 3] = joint, 1 end
        return copy
    end
    local with_skin = lissom.merge{
        joins = { { source = rim(skinned(cap, 1)), target = rim(skinned(bowl, 2)) } },
    }
    expect.truthy(with_skin:is_closed())
end)

test("loops of no length, and small ones", function()
    local flat = cap:copy()
    for _, v in ipairs(rim(flat):vertices()) do flat:set_position(v, 0, 0, 0) end
    merging_fails("boundary_conflict", nil, { { source = rim(flat), target = rim(bowl) } })
    local corner = lissom.mesh{
        positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
        faces = { { 1, 3, 2 }, { 1, 2, 4 }, { 1, 4, 3 } },
    }
    expect.equal(#rim(corner), 3)
    local tiny = lissom.merge{ joins = { { source = rim(corner), target = rim(bowl) } } }
    expect.truthy(tiny:is_closed())
    local onto_tiny = lissom.merge{ joins = { { source = rim(cap), target = rim(corner) } } }
    expect.truthy(onto_tiny:is_closed())
end)

test("values that make no sense", function()
    for _, options in ipairs{
        { smooth = -1 }, { transition = { source = -1 } }, { reach = 0, configuration = "fixed" },
        { max_turn = 200 },
    } do
        options.joins = { join() }
        fails("invalid_argument", nil, function() lissom.merge(options) end)
    end
end)

test("a join that is written wrongly says which field, and how to get a boundary", function()
    do
        local function refused(text, one)
            expect.error(function() lissom.merge{ joins = { one } } end, text)
        end
        refused("no field 'key', did you mean 'keys'?", { source = rim(cap), target = rim(bowl), key = {} })
        refused("expected in 'source', got lissom.Mesh; write source:boundaries()[1]",
            { source = cap, target = rim(bowl) })
        refused("expected in 'target', got table; write mesh:boundaries()[1]",
            { source = rim(cap), target = bowl:boundaries() })
    end
end)

test("a source that stays where it was put meets what is nearest, and that is no guess", function()
    do
        local over = half(ball(16)):transform{ translate = { 0, 0.3, 0 } }
        local below = half(ball(20), 0, { 0, -1, 0 })
        local joins = { { source = rim(over), target = rim(below) } }
        local placed, of_placed = lissom.merge{ configuration = "fixed", joins = joins }
        expect.truthy(placed:is_closed() and not of_placed.joins[1].guessed)
        expect.truthy(of_placed.ok)
        for _, warning in ipairs(of_placed.warnings) do
            expect.truthy(not warning:find("guess", 1, true))
        end
        local _, of_free = lissom.merge{ joins = joins }
        expect.truthy(not of_free.joins[1].guessed and of_free.joins[1].turn.angle < 0.5)
        local _, of_shape = lissom.merge{ joins = joins, place = "shape" }
        expect.truthy(of_shape.joins[1].any_turn or of_shape.joins[1].certainty < 0.75)
    end
end)

test("the report tells the seam and the transition as regions of the merged mesh", function()
    local plain, told = lissom.merge{ joins = { join{ { from, to } } } }
    expect.equal(told.transition.region, nil)
    local seam = told.seam.region
    for _, v in ipairs(told.seams[1]:vertices()) do expect.truthy(seam:contains(v)) end
    expect.truthy(#seam > #told.seams[1] and #seam < plain:vertex_count() / 2)
    expect.truthy(plain:set_region("seam", seam):region("seam"))
    local blended, band = lissom.merge{ joins = { join{ { from, to } } },
        transition = { source = 0.5, target = 1 } }
    local moved = band.transition.region
    expect.truthy(#moved > 0 and #moved < blended:vertex_count())
    -- Elsewhere nothing differs from the merge without a transition.
    expect.equal(blended:vertex_count(), plain:vertex_count())
    for v = 1, plain:vertex_count() do
        local x, y, z = plain:position(v)
        local p, q, r = blended:position(v)
        if not moved:contains(v) then expect.truthy(x == p and y == q and z == r) end
    end
end)

test("a thin outline that is to meet a round one is told before anything is solved", function()
    local function thin(aspect)
        local stretched = half(ball(24))
        local points = stretched:positions()
        for v = 1, #stretched do
            stretched:set_position(v, aspect * points[3 * v - 2], points[3 * v - 1], points[3 * v])
        end
        return lissom.merger{ joins = { { source = rim(stretched), target = rim(bowl) } } }
    end
    expect.equal(#thin(1.5):warnings(), 0)
    local told = thin(6):warnings()
    expect.equal(#told, 1)
    expect.truthy(told[1]:find("axes [56]%.%d : 1") and told[1]:find("lissom.paste", 1, true))
end)

-- A tube of `sides` and four rings from `first` to `last` along x, not quite round.
local function slender_tube(sides, first, last)
    local positions, faces = {}, {}
    for ring = 0, 4 do
        for k = 0, sides - 1 do
            local angle = 2 * math.pi * k / sides
            local radius = 1 + 0.1 * math.cos(3 * angle)
            positions[#positions + 1] = { first + (last - first) * ring / 4,
                radius * math.cos(angle), radius * math.sin(angle) }
        end
    end
    for ring = 0, 3 do
        for k = 1, sides do
            local a, b = ring * sides + k, ring * sides + k % sides + 1
            faces[#faces + 1] = { a, b, b + sides, a + sides }
        end
    end
    return lissom.mesh{ positions = positions, faces = faces }
end

test("loops of thousands of vertices, with faces much longer than wide, are joined", function()
    local source, target = slender_tube(2000, 0, 2), slender_tube(250, 2.2, 4.2)
    local function near(part, x)
        for _, boundary in ipairs(part:boundaries()) do
            if math.abs(boundary:points()[1][1] - x) < 0.1 then return boundary end
        end
    end
    local joined, told = lissom.merge{ configuration = "fixed", reach = 1.6, collar = false, source = source,
        target = target, joins = { { source = near(source, 2), target = near(target, 2.2),
            keys = { { { 2, 1.1, 0 }, { 2.2, 1.1, 0 } } } } } }
    expect.truthy(joined)
    expect.equal(#told.intersections, 0)
    expect.truthy(told.seam.after.max_dihedral < 10)
    local bounds = joined:bounds()
    expect.near(bounds.min[1], 0, 1e-9)
    expect.near(bounds.max[1], 4.2, 1e-9)
    expect.truthy(bounds.max[2] < 1.2 and bounds.min[2] > -1.2)
end)

test("without joins the nearest boundaries meet", function()
    local whole, of_whole = lissom.merge(cap, bowl)
    expect.truthy(whole:is_closed())
    same(whole, lissom.merge{ joins = { join() } }, 0)
    same(lissom.merge{ source = cap, target = bowl }, whole, 0)
    expect.equal(#of_whole.joins, 1)
    -- Of a tube that is open at both ends the end that is nearer to each cap.
    local pipe = lissom.shapes.cylinder{ radius = 1, height = 4, segments = 24, rings = 8, caps = false }
    local upper = half(ball()):transform{ translate = { 0, 2.3, 0 } }
    local lower = half(ball(), 0, { 0, -1, 0 }):transform{ translate = { 0, -2.2, 0 } }
    local with_cap = lissom.merge(upper, pipe)
    expect.equal(#with_cap:boundaries(), 1)
    expect.truthy(with_cap:boundaries()[1]:points()[1][2] < 0)
    expect.truthy(lissom.merge(lower, with_cap, { smooth = 0 }):is_closed())
    -- A tube between two targets has one join with each.
    local both, of_both = lissom.merge(pipe, { upper, lower })
    expect.equal(#of_both.joins, 2)
    expect.truthy(both:is_closed())
    expect.failure("not_a_boundary", lissom.merge, ball(), bowl)
    expect.error(function() lissom.merge(cap) end, "a source and a target")
    expect.error(function() lissom.merge{} end, "a source and a target")
    expect.error(function() lissom.merge(cap, bowl, { source = cap }) end, "source")
    expect.truthy(lissom.merger(cap, bowl):solve():is_closed())
    -- Within one mesh the two boundaries that are nearest to each other.
    expect.equal(lissom.merge(pipe, pipe):genus(), 1)
end)
