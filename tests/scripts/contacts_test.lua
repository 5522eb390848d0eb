-- deformer:contacts() and drags that stop at contacts.

local lissom = require "lissom"

-- A bar, its deformer, and the handle of its upper end.
local function bar_with_top()
    local bar = lissom.shapes.bar{ width = 1, length = 6, across = 4, along = 24 }
    local deformer = lissom.deformer(bar):pin(bar:region("bottom"))
    return bar, deformer, deformer:add_handle(bar:region("top"))
end

-- The upper end comes down onto the lower one.
local function fold(top)
    top:set{ rotate = { axis = "z", angle = 160 }, translate = { 0.3, -5, 0 } }
end

test("contacts: pairs, their faces and their region", function()
    local bar, deformer, top = bar_with_top()
    expect.equal(#deformer:contacts(), 0)
    fold(top)
    deformer:solve()
    local found = deformer:contacts()
    expect.truthy(#found > 0)
    expect.equal(#found, deformer:report{ crossings = true }.crossings)
    local is_listed = {}
    for _, face in ipairs(found.faces) do is_listed[face] = true end
    for i, pair in ipairs(found) do
        expect.truthy(pair[1] < pair[2] and is_listed[pair[1]] and is_listed[pair[2]])
        for _, face in ipairs(pair) do
            for _, v in ipairs(bar:face(face)) do expect.truthy(found.region:contains(v)) end
        end
        local before = found[i - 1]
        expect.truthy(not before or before[1] <= pair[1])
    end
    deformer:reset()
    expect.equal(#deformer:contacts(), 0)
    expect.equal(#deformer:contacts().faces, 0)
    expect.equal(#deformer:contacts().region, 0)
end)

test("stop: the mesh and the handle stay at the last pose without contact", function()
    local bar, deformer, top = bar_with_top()
    fold(top)
    local mesh, stop = deformer:solve{ stop = "contact" }
    expect.truthy(mesh == bar)
    expect.truthy(stop.share > 0 and stop.share < 1)
    expect.truthy(#stop.contacts > 0 and #stop.contacts.faces > 1)
    expect.equal(#deformer:contacts(), 0)
    local reached = bar:hash()
    deformer:solve()
    expect.equal(bar:hash(), reached)
    top:set{ translate = { 0.2, 0, 0 } }
    local _, free = deformer:solve{ stop = "contact" }
    expect.equal(free.share, 1)
    expect.equal(#free.contacts, 0)
    expect.equal(select("#", deformer:solve()), 1)
end)

test("stop: misuse", function()
    local bar, deformer, top = bar_with_top()
    expect.error(function() deformer:solve{ stop = "wall" } end, "contact")
    expect.error(function() deformer:solve{ stop = "contact", draft = true } end, "draft")
    fold(top)
    local before = bar:hash()
    bar:triangulate()
    local after = bar:hash()
    expect.truthy(before ~= after)
    expect.error(function() deformer:solve{ stop = "contact" } end, "[topology_mismatch]")
    expect.error(function() deformer:contacts() end, "[topology_mismatch]")
    expect.equal(bar:hash(), after)
end)
