--- Turns, moves and zooms the view, as the window itself does without a tool; recordings have it too.
--
-- Drag to turn, with shift to move, with ctrl up and down to come nearer or go away. Keys: 1 to 6 look from
-- the six sides, 7 from between them; f shows the selection, else all, F all; o toggles perspective. A tool
-- that wants another view calls ev:look with a camera, as this one does.
local lissom = require "lissom"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"
local vectors = require "vectors"

-- Direction to the camera from its target, and the up direction of the picture, if y points up.
local sides = {
    ["1"] = { { 0, 0, 1 } }, ["2"] = { { 0, 0, -1 } }, ["3"] = { { -1, 0, 0 } }, ["4"] = { { 1, 0, 0 } },
    ["5"] = { { 0, 1, 0 }, { 0, 0, -1 } }, ["6"] = { { 0, -1, 0 }, { 0, 0, 1 } }, ["7"] = { { 1, 0.6, 1.2 } },
}

-- The same direction if `up` points up: z instead of y by a quarter turn about x.
local function to_world(direction, up)
    if up == "y" then return direction end
    return { direction[1], -direction[3], direction[2] }
end

local function add_vertices(points, one, vertices)
    for _, v in ipairs(vertices) do
        local x, y, z = one.mesh:position(v)
        table.insert(points, matrices.point(one.place, { x, y, z }))
    end
end

-- The selected vertices of all visible meshes in the world; all vertices if none is selected, or `all`.
local function points_of(scene, all)
    local points = {}
    for _, one in ipairs(all and {} or meshes.visible(scene)) do
        add_vertices(points, one, meshes.selection(one.mesh):vertices())
    end
    if #points > 0 then return points end
    for _, one in ipairs(meshes.visible(scene)) do
        add_vertices(points, one, one.mesh:region{ all = true }:vertices())
    end
    return points
end

-- The camera looking from a side, and showing all.
local function seen_from(ev, side)
    local camera, points = ev.camera, points_of(ev.scene, true)
    local eye = vectors.plus(camera:target(), vectors.unit(to_world(side[1], ev.up)), vectors.length(
        vectors.plus(camera:eye(), camera:target(), -1)))
    local turned = lissom.camera{ eye = eye, target = camera:target(),
        up = to_world(side[2] or { 0, 1, 0 }, ev.up), fov = camera:fov(), ortho = camera:ortho() }
    return #points > 0 and turned:frame(points, ev.size) or turned
end

local function framed(ev, all)
    local points = points_of(ev.scene, all)
    return #points > 0 and ev.camera:frame(points, ev.size) or ev.camera
end

local keys = {
    f = function(ev) return framed(ev, false) end,
    F = function(ev) return framed(ev, true) end,
    o = function(ev) return ev.camera:parallel(ev.camera:ortho() == nil) end,
}
for key, side in pairs(sides) do
    keys[key] = function(ev) return seen_from(ev, side) end
end

return lissom.tool{
    name = "navigate",
    help = "Drag: turns; shift: moves; ctrl: nearer. Keys: 1 to 7 sides, f(rame), F: all, o: perspective.",
    params = {
        by = { type = "choice", default = "turn", choices = { "turn", "move", "zoom" },
            help = "effect of a drag without shift and ctrl" },
        doubling = { type = "number", default = 150, min = 10, max = 2000, unit = "pixels",
            help = "A drag of so many pixels comes twice as near." },
    },
    -- A drag always counts from its start: the number of its events does not matter.
    press = function(self, ev)
        local by = ev.shift and "move" or ev.ctrl and "zoom" or self.params.by
        self.held = { camera = ev.camera, by = by, x = ev.x, y = ev.y }
    end,
    drag = function(self, ev)
        local held = self.held
        if not held then return end
        local right, down = ev.x - held.x, ev.y - held.y
        if held.by == "turn" then
            ev:look(held.camera:orbit(right, down, ev.size))
        elseif held.by == "move" then
            ev:look(held.camera:pan(right, down, ev.size))
        else
            ev:look(held.camera:zoom(held.x, held.y, 2 ^ (-down / self.params.doubling), ev.size))
        end
    end,
    release = function(self) self.held = nil end,
    key = function(_, ev)
        if keys[ev.key] then ev:look(keys[ev.key](ev)) end
    end,
    cancel = function(self, ev)
        if self.held then ev:look(self.held.camera) end
        self.held = nil
    end,
    deactivate = function(self) self.held = nil end,
}
