-- A horn of one model on another: the best boundary around it, and the seam that nobody sees.
--
--     lissom run examples/merge/paste.lua
--     lissom run examples/merge/paste.lua --x 1 --y 1.2 --z 0.8 --scale 0.5

local lissom = require "lissom"

local params = lissom.params{
    x = { type = "number", default = 0.5, min = -3, max = 3, help = "place of the horn" },
    y = { type = "number", default = 1.7, min = -3, max = 3, help = "place of the horn" },
    z = { type = "number", default = 0.5, min = -3, max = 3, help = "place of the horn" },
    scale = { type = "number", default = 0.8, min = 0.1, max = 2, help = "its size" },
    out = { type = "folder", default = "out", help = "folder that the file goes to" },
}

-- A ball with a bent horn, and an egg to put it on.
local ball = lissom.shapes.sphere{ segments = 40, kind = "triangles" }
for i = 1, ball:vertex_count() do
    local x, y, z = ball:position(i)
    if y > 0 then
        local rise = math.exp(-14 * (x * x + z * z))
        ball:set_position(i, x + 0.35 * rise * rise, y + 0.9 * rise, z)
    end
end
local egg = lissom.shapes.sphere{ segments = 24, kind = "triangles" }:transform{ scale = { 1.4, 2, 1.6 } }

-- The region around the horn is marked casually.
local paste = lissom.paste{
    source = ball, target = egg,
    region = ball:region{ sphere = { center = { 0, 1.3, 0 }, radius = 0.9 } },
    placement = { at = { params.x, params.y, params.z }, scale = params.scale },
}
local loop, search = paste:optimize()
local mesh, report = paste:merge()
assert(mesh:is_closed() and mesh:genus() == 0)
print(string.format("misfit %.3g in place of %.3g, %d vertices, scale %.3g; %s",
    search.misfit[#search.misfit], search.misfit[1], #loop, report.paste.scale, report.verdict))
mesh:save(params.out .. "/paste.obj")
