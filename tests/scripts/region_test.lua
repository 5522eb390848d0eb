local lissom = require "lissom"

local grid = lissom.shapes.grid{ size = 2, segments = 20 }
local left = grid:region{ plane = { point = { 0, 0, 0 }, normal = { -1, 0, 0 } } }

test("constructors", function()
    expect.equal(#grid:region{ all = true }, #grid)
    expect.equal(#grid:region{ sphere = { center = { 0, 0, 0 }, radius = 0.1 } }, 5)
    expect.equal(#grid:region{ box = { min = { 0, -1, 0 }, max = { 1, 1, 1 } } }, 121)
    expect.equal(#grid:region{ box = { min = { 0.95, -1 / 0, -1 / 0 } } }, 21)
    expect.equal(#grid:region{ plane = { point = { 0.9, 0, 0 }, normal = { 1, 0, 0 } } }, 42)
    expect.equal(#grid:region{ vertices = { 1, 5, 5, 7 } }, 3)
    expect.equal(#grid:region{ component = 1 }, #grid)
    expect.equal(#grid:region{ where = function(i) return i <= 10 end }, 10)
    local disk = grid:region{ geodesic = { from = grid:nearest(0, 0, 0).vertex, radius = 0.5 } }
    expect.truthy(#disk > 60 and #disk < 100)
    expect.truthy(#grid:region{ geodesic = { from = grid:region("border"), radius = 0 } } >= 80)
    grid:add_attribute{ name = "heat" }[3] = 7
    expect.near(grid:region{ attribute = { "heat", 5, 1 / 0 } }:vertices(), { 3 })
end)

test("boxes with open sides, and in fractions of the bounds", function()
    expect.equal(#grid:region{ box = { min = { 0.95 } } }, 21)
    expect.equal(#grid:region{ box = { min = { nil, nil, 0.95 }, max = { 0, math.huge, nil } } }, 11)
    expect.equal(#grid:region{ fraction = { min = { 0.975, nil, nil } } }, 21)
    expect.equal(#grid:region{ fraction = { min = { 0, 0, 0 }, max = { 1, 1, 1 } } }, #grid)
    expect.equal(#grid:region{ fraction = { max = { 0, nil, 0 } } }, 1)
    expect.equal(#grid:region{ fraction = { min = { nil, nil, nil } } }, #grid)
    expect.equal(#grid:region{ box = { min = {}, max = { 0.95 } } }, #grid:region{ box = { max = { 0.95 } } })
    for _, box in ipairs{ { min = { 1, 2, 3, 4 } }, { max = { x = 1 } }, { max = 2 } } do
        expect.error(function() grid:region{ box = box } end, "nil or math.huge for an open side")
    end
end)

test("distances from a point, which need not be a vertex", function()
    local point = { 0.03, 0, 0.02 }
    local around = grid:region{ geodesic = { from = point, radius = 0.5 } }
    expect.truthy(#around > 60 and #around < 100)
    expect.truthy(around == grid:region{ geodesic = { from = grid:nearest(point), radius = 0.5 } })
    expect.truthy(around == grid:region{ geodesic = { from = { point = point }, radius = 0.5 } })
    local three = { vertices = { 1, 2, 3 } }
    expect.equal(grid:region{ geodesic = { from = three, radius = 0 } }, grid:region(three))
    expect.equal(#grid:region{ geodesic = { from = { 1, 2, 3, 4 }, radius = 0 } }, 4)
    local away = grid:distances{ from = point }
    for i = 1, #grid do
        local x, _, z = grid:position(i)
        expect.near(away[i], math.sqrt((x - 0.03) ^ 2 + (z - 0.02) ^ 2), 0.05)
    end
    expect.truthy(grid:distances{ from = point, method = "edges" }[1] >= away[1])
    expect.error(function() grid:distances{ from = { 1, 2, 3 } } end, "may be a point or vertices")
    expect.error(function()
        grid:region{ geodesic = { from = { 10, 20, 5 }, radius = 1 } }
    end, "may be a point or vertices")
    local wrong = {
        { 0.5 }, { "a" }, { 1.5, 2, 3, 4 }, { point = { 1, 2 } }, { vertices = { 0 } }, { 0 / 0, 1, 2 },
    }
    for _, from in ipairs(wrong) do
        expect.error(function() grid:distances{ from = from } end, "bad option 'from'")
    end
    expect.error(function()
        grid:region{ geodesic = { from = "a", radius = 1 } }
    end, "bad option 'geodesic.from'")
end)

test("wrong ones", function()
    expect.error(function() grid:region{} end, "'region' needs a name or exactly one of the options")
    expect.error(function() grid:region{ all = true, component = 1 } end, "got 2")
    expect.error(function() grid:region{ attribute = { "heat", 5 } } end, "{name, min, max} expected")
    expect.error(function() grid:region{ all = false } end, "true expected, got false")
    expect.error(function() grid:region{ vertices = { 442, 443 } } end, "vertices 442 and 443")
    expect.error(function() grid:region{ sphere = { centre = { 0, 0, 0 } } } end, "did you mean 'center'?")
    expect.error(function() grid:region{ group = "hand" } end, "[invalid_argument]")
    local problem = expect.failure("out_of_range", grid.region, grid, "boder")
    expect.truthy(problem.message:find("did you mean 'border'?", 1, true))
end)

test("set operations", function()
    local right = grid:region{ plane = { point = { 0, 0, 0 }, normal = { 1, 0, 0 } } }
    expect.equal(#left:union(right), #grid)
    expect.equal(#left:intersect(right), 21)
    expect.equal(#left:minus(right), #left - 21)
    expect.truthy(left:invert() == right:minus(left))
    expect.equal(#left:grow(), #left + 21)
    expect.truthy(left:shrink():grow() == left)
    expect.truthy(#left:smooth(2) > 0)
    expect.truthy(left:contains(left:vertices()[1]) and not left:contains(right:vertices()[#right]))
    expect.near(left:center(), { -0.5, 0, 0 })
    expect.near(left:bounds().max, { 0, 0, 1 })
    expect.equal(#left:faces(), 200)
    expect.equal(#left:boundaries(), 1)
    expect.truthy(rawequal(left:mesh(), grid))
    expect.truthy(tostring(left):find("231 of 441"))
end)

test("the part that is connected with a point", function()
    local far_side = grid:region{ fraction = { min = { 0.9, nil, nil } } }
    local edges = grid:region{ fraction = { max = { 0.1, nil, nil } } }:union(far_side)
    local part = edges:connected{ at = { 0.4, 3, 0 } }
    expect.truthy(part == far_side)
    expect.truthy(edges:connected{ at = part:vertices()[1] } == part)
    expect.error(function()
        part:connected{ at = edges:minus(part):vertices()[1] }
    end, "is not in the region")
    expect.error(function() part:connected() end, "missing option 'at'")
    expect.error(function() grid:region{ vertices = {} }:connected{ at = { 0, 0, 0 } } end, "[region_empty]")
end)

test("named regions stay with the mesh and move to copies", function()
    grid:set_region("left", left)
    expect.truthy(grid:region("left") == left)
    expect.equal(#grid:copy():region("left"), #left)
    expect.equal(table.concat(grid:regions(), " "), "border left")
    expect.truthy(grid:remove_region("left"))
    expect.truthy(not grid:remove_region("left"))
end)

test("regions of another mesh, or of an older topology", function()
    local other = lissom.shapes.grid{ size = 2, segments = 20 }
    expect.error(function() left:union(other:region{ all = true }) end, "[topology_mismatch]")
    expect.error(function() other:set_region("left", left) end, "[topology_mismatch]")
    grid:triangulate()
    for _, use in ipairs{ "grow", "vertices", "center", "bounds", "faces", "invert", "boundaries" } do
        expect.error(function()
            local result = left[use](left) -- not returned at once: a tail call knows no line
            return result
        end, "older version of this mesh's topology")
    end
    expect.failure("topology_mismatch", function() return #left end)
    expect.equal(tostring(left), "lissom.Region (of an older topology)")
end)

test("empty regions", function()
    local none = grid:region{ vertices = {} }
    expect.equal(#none, 0)
    expect.error(function() none:center() end, "[region_empty]")
    expect.error(function() none:bounds() end, "[region_empty]")
    expect.error(function() grid:extract(none) end, "[region_empty]")
end)
