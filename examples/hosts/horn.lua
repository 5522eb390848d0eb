--- Pastes a horn onto a mesh, where a direction from its middle leaves it.
local lissom = require "lissom"

local p = lissom.params{
    mesh = { type = "mesh", default = "", help = "the mesh that gets the horn; empty: a ball" },
    azimuth = { type = "number", default = 30, min = -180, max = 180, unit = "degrees",
        help = "around the mesh" },
    elevation = { type = "number", default = 40, min = -90, max = 90, unit = "degrees",
        help = "above its middle" },
    size = { type = "number", default = 0.5, min = 0.05, max = 2,
        help = "of the horn, times that of the mesh" },
    bow = { type = "number", default = 50, min = -90, max = 90, unit = "degrees", help = "bow of the horn" },
}

-- A ball of which the top is drawn out to a horn; returns it with the horn and the surface around it.
local function horned_ball()
    local ball = lissom.shapes.sphere{ segments = 17, kind = "triangles" }
    local region = ball:region{ plane = { point = { 0, 0.6, 0 }, normal = { 0, 1, 0 } } }
    local top = ball:region{ plane = { point = { 0, 0.99, 0 }, normal = { 0, 1, 0 } } }
    local deformer = lissom.deformer(ball)
    deformer:pin(ball:region{ plane = { point = { 0, 0.88, 0 }, normal = { 0, -1, 0 } } })
    local tip = deformer:add_handle(top)
    tip:scale(0.15)
    tip:rotate("x", p.bow)
    tip:translate(0, 1.2, 0.01 * p.bow)
    deformer:solve()
    return ball, region
end

-- The point where the mesh is left in a direction from its middle.
local function place_on(mesh)
    local a, e = math.rad(p.azimuth), math.rad(p.elevation)
    local way = { math.cos(e) * math.sin(a), math.sin(e), math.cos(e) * math.cos(a) }
    local bounds, far = mesh:bounds(), {}
    for k = 1, 3 do far[k] = bounds.center[k] + bounds.diagonal * way[k] end
    return mesh:nearest(far).position
end

local mesh
if p.mesh == "" then
    mesh = lissom.shapes.sphere{ segments = 24, kind = "triangles" }
else
    mesh = lissom.load(p.mesh)
end
local horn, region = horned_ball()
local paste = lissom.paste{ source = horn, target = mesh, region = region, placement = {
    at = place_on(mesh), up = { 0, 0, 1 }, toward = { 0, 1, 0 }, scale = p.size * mesh:size() } }
paste:optimize()
return (paste:merge{})
