-- The library of merging: directions, cuts, keys, recipes.
local blocks = require "blocks"
local lissom = require "lissom"
local merging = require "merging"
local models = require "models"

local head, torso, options = require("recipes.transplant_head").example(3)
options.keys = "z = z; -z = -z"
local head_hash = head:hash()
local mesh, report, parts = merging.join(head, torso, options)

local function expect_whole(name, result, of_result, of_parts)
    if not result then error(name .. ": " .. tostring(of_result), 2) end
    expect.equal(result:components(), 1)
    expect.truthy(result:is_manifold())
    expect.truthy(of_result.seam.after.max_dihedral < 30)
    expect.truthy(#of_parts.joins == #of_result.joins)
    return result
end

test("what scripts and command lines say", function()
    expect.near(merging.direction("-y"), { 0, -1, 0 })
    expect.near(merging.direction(" +z "), { 0, 0, 1 })
    expect.near(merging.direction("1, -0.5, 2"), { 1, -0.5, 2 })
    expect.error(function() merging.direction("up") end, "a direction is")
    expect.error(function() merging.direction{ 0, 0, 0 } end, "a direction is")
    local cut = merging.read_cut("0, 1, 2; 0, 0, 1; 5, 5, 5")
    expect.near(cut.point, { 0, 1, 2 })
    expect.near(cut.normal, { 0, 0, 1 })
    expect.near(cut.seed, { 5, 5, 5 })
    expect.equal(merging.read_cut("0,1,2; 0,0,1").seed, nil)
    expect.equal(merging.read_cut(""), nil)
    expect.error(function() merging.read_cut("0, 1; 0, 0, 1") end, "a cut is")
    expect.error(function() merging.read_cut("0, 1, 0") end, "a cut is")
    local pairs_of = merging.read_keys("y = -z; 1, 0, 0 = x")
    expect.equal(#pairs_of, 2)
    expect.near(pairs_of[1][2], { 0, 0, -1 })
    expect.error(function() merging.read_keys("y, z") end, "keys are")
    expect.near(merging.turned("z", "y", 90), { 1, 0, 0 }, 1e-12)
end)

test("boundaries by where they lie", function()
    local tube = lissom.shapes.cylinder{ radius = 1, height = 4, segments = 32, caps = false }
    local low = merging.boundary_near(tube, { 0, -9, 0 })
    expect.near(merging.center(low)[2], -2)
    expect.near(merging.axis(low), { 0, -1, 0 }, 1e-12)
    expect.near(merging.axis(merging.boundary_near(tube, { 0, 9, 0 })), { 0, 1, 0 }, 1e-12)
    local x, _, z = tube:position(merging.extreme(low, { 3, 0, 0 }))
    expect.near({ x, z }, { 1, 0 }, 1e-12)
    -- Of many that are as far, the one in the middle.
    local grid = lissom.shapes.grid{ size = { 2, 2 }, segments = { 10, 10 } }
    local gx, _, gz = grid:position(merging.extreme(grid:boundaries()[1], "z"))
    expect.near({ gx, gz }, { 0, 1 }, 1e-12)
    local wide = merging.part(tube, { point = { 0, 1, 0 }, normal = "-y" })
    expect.equal(#wide:boundaries(), 2)
    expect.error(function() merging.part(lissom.shapes.box()) end, "the mesh is closed")
    expect.failure("boundary_conflict", merging.part, lissom.shapes.torus(),
        { point = { 1, 0, 0 }, normal = "z" })
end)

test("a join is the same from everywhere, and its options are checked", function()
    expect.truthy(mesh:is_manifold() and #mesh:boundaries() == 0)
    expect.equal(head:hash(), head_hash)
    expect.equal(#parts.targets, 1)
    expect.truthy(rawequal(parts.source, parts.joins[1].source:mesh()))
    expect.truthy(report.seam.after.max_dihedral < 25)
    for number = 1, 3 do expect.truthy(merging.configuration_error(mesh, parts, number) < 1e-9) end
    expect.error(function() merging.join(head, torso, { key = "" }) end, "unknown option 'key' of 'join'")
    local reason = select(2, lissom.try(merging.join, head, torso, { source_cut = "0, 9, 0; 0, 1, 0" }))
    expect.truthy(reason.message:find("source: .*does not cross the mesh"))
    expect.failure("key_conflict", merging.join, head, torso, { source_cut = options.source_cut,
        keys = "z = z; x = -x; -z = -z; -x = x" })
end)

test("a copy in its place lies at the opening and looks at it", function()
    local from, to = parts.joins[1].source, parts.joins[1].target
    local placed, there = merging.placed(from, to, { "z", "z" })
    expect.near(merging.center(there), merging.center(to), 1e-9)
    expect.near(there:length(), to:length(), 1e-9)
    local into, out = merging.axis(there), merging.axis(to)
    for k = 1, 3 do expect.near(into[k], -out[k], 1e-9) end
    expect.equal(#placed, #parts.source)
end)

test("recipes: each makes one closed surface of its example", function()
    for _, name in ipairs{ "transplant_head", "add_tail", "ears", "replace_limb" } do
        local recipe = require("recipes." .. name)
        local source, target, own = recipe.example(2)
        local before_source, before_target = source:hash(), target:hash()
        local result = expect_whole(name, recipe.make(source, target, own))
        expect.truthy(result:is_closed())
        expect.equal(result:genus(), 0)
        expect.equal(source:hash(), before_source)
        expect.equal(target:hash(), before_target)
        expect.error(function()
            recipe.make(source, target, { colour = 1 })
        end, "unknown option 'colour' of '" .. name .. "'")
    end
end)

test("recipes tell what their cuts found, and take all options of a merge", function()
    local transplant = require "recipes.transplant_head"
    local plenty = { source_cut = { point = { 0, -0.295, 0 }, normal = "y" },
        intersections = false, max_turn = 30 }
    local _, of_plenty, plenty_parts = transplant.make(head, torso, plenty)
    expect.equal(#of_plenty.intersections, 0)
    expect.truthy(of_plenty.verdict:find("were not looked for", 1, true))
    expect.truthy(table.concat(plenty_parts.warnings, "\n"):find("source: the cut keeps %d+ %% of the mesh"))
    plenty.source_cut = { point = { 0, -0.12, 0 }, normal = "y" }
    local _, _, half_parts = transplant.make(head, torso, plenty)
    expect.equal(#half_parts.warnings, 0)
    local unpack_list = table.unpack or _G["unpack"]
    local example_of = {}
    for _, name in ipairs{ "add_tail", "ears", "replace_limb", "stack" } do
        example_of[name] = { require("recipes." .. name).example(2) }
    end
    local ear, face, of_ear = unpack_list(example_of.ears)
    of_ear.source_cut = { point = { ear:bounds().center[1], ear:bounds().min[2] + 0.1, 0 }, normal = "y" }
    local _, _, ear_parts = require("recipes.ears").make(ear, face, of_ear)
    expect.truthy(table.concat(ear_parts.warnings, "\n"):find("ear: the cut keeps", 1, true))
    local arm, beast, of_arm = unpack_list(example_of.replace_limb)
    local _, _, arm_parts = require("recipes.replace_limb").make(arm, beast, of_arm)
    expect.truthy(table.concat(arm_parts.warnings, "\n"):find("place 1: the cut keeps", 1, true))
end)

test("directions are ambiguous as keys where a boundary is tilted towards them: that is said", function()
    local tilted = lissom.shapes.cylinder{ radius = 1, height = 4, segments = 32, caps = false }
    tilted = merging.part(tilted, { point = { 0, 0, 0 }, normal = { 0, 1, 1.2 } })
    local slanted = merging.boundary_near(tilted, { 0, -1, 0 })
    expect.near(merging.tilt(slanted, "x"), 0, 1)
    expect.near(merging.tilt(slanted, "z"), 50, 2)
    local _, of_clear = merging.keys(slanted, slanted, { { "x", "-x" } })
    expect.equal(#of_clear, 0)
    local _, of_tilt = merging.keys(slanted, slanted, { { { 0, 1, 1 }, "x" } })
    expect.equal(#of_tilt, 1)
    expect.truthy(of_tilt[1]:find("key 1: the source's boundary is tilted", 1, true))
end)

test("directions as of merging are taken by a merge without keys", function()
    local by_front, of_front = merging.join(head, torso, { source_cut = options.source_cut,
        source_front = "z", target_front = "0, 0, 1" })
    expect.truthy(by_front:is_closed() and not of_front.joins[1].guessed)
    expect.equal(of_front.joins[1].placed, "directions")
end)

test("the head turns with its parameter", function()
    local transplant_head = require "recipes.transplant_head"
    local function nose(turn)
        local with = { source_cut = options.source_cut, turn = turn }
        local whole, of_whole = transplant_head.make(head, torso, with)
        local best, most = nil, -math.huge
        for v = 1, #parts.source do
            local nx, ny, nz = parts.source:position(v)
            if nz > most and ny > -0.1 then best, most = { nx, ny, nz }, nz end
        end
        for v = 1, #whole do
            local origins = of_whole.provenance:vertex(v)
            if #origins == 1 and origins[1].side == "source" then
                local p = { parts.source:position(origins[1].vertex) }
                if p[1] == best[1] and p[2] == best[2] and p[3] == best[3] then return whole:position(v) end
            end
        end
    end
    local x0, _, z0 = nose(0)
    local x90, _, z90 = nose(90)
    expect.truthy(math.abs(x0) < 0.3 and z0 > 0.3)
    expect.truthy(x90 > 0.3 and math.abs(z90) < 0.6)
end)

test("ears are mirror images; limbs too", function()
    local ears = require "recipes.ears"
    expect.error(function() ears.make(head, torso, {}) end, "needs the option 'left'")
    local replace_limb = require "recipes.replace_limb"
    expect.error(function() replace_limb.make(head, torso, {}) end, "needs 'target_cut' or 'places'")
    local limb, body, places = replace_limb.example(2)
    local two_legs = replace_limb.make(limb, body, places)
    expect.near(two_legs:bounds().max[1], -two_legs:bounds().min[1], 0.05)
end)

test("stacks grow", function()
    local stack = require "recipes.stack"
    local list, own = stack.example(2, 4)
    local tower, last, of_tower, reports = stack.make(list, own)
    expect_whole("stack", tower, last, of_tower)
    expect.equal(#reports, 3)
    expect.truthy(tower:is_closed() and tower:bounds().max[2] > list[1]:bounds().max[2] + 0.5)
    expect.error(function() stack.make({ list[1] }) end, "two or more parts")
end)

test("blocks", function()
    expect.equal(#blocks.cells{ { 0, 0, 0, 1, 1, 1 }, { 0, 0, 0 } }, 8)
    expect.equal(blocks.valve{ levels = 2 }:genus(), 1)
    expect.equal(#blocks.valve{ levels = 2 }:boundaries(), 4)
    expect.error(function()
        blocks.surface{ cells = { { 0, 0, 0 }, { 1, 1, 0 } } }
    end, "these cells have no surface")
end)

test("known pairs", function()
    local merge_pairs = require "merge_pairs"
    expect.equal(#merge_pairs.names(), 8)
    expect.error(function() merge_pairs.load("hydra", ".") end, "there are: camel_on_cow")
    expect.failure("file_not_found", merge_pairs.load, "mermaid", "no/such/folder")
end)

test("a mermaid of models", function()
    local folder = models.path("models/fish_oded.obj"):match("^(.*)/")
    local fish, venus, own_options = require("merge_pairs").load("mermaid", folder)
    local mermaid, of_mermaid = merging.join(fish, venus, own_options)
    expect.truthy(mermaid:is_manifold() and of_mermaid.seam.after.max_dihedral < 10.8)
end)
