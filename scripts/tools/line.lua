--- Draws lines on surfaces: features, seams, borders. Each is a polyline, an object of the scene.
--
-- Drag over a mesh: a line on it, fair between its corners; back to its start it is closed. by edges: along
-- the edges of faces. With shift a line continues at the end of the last one. Backspace takes the last one
-- away.
local lissom = require "lissom"
local drawn_line = require "tools.support.drawn_line"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"

local near = 20                 -- pixels within which a line comes back to its beginning

-- Line of a stroke: points of the mesh's own space, and whether they are closed.
local function on_surface(ev, one, drawn, params)
    local back, line, vertices = matrices.inverse(one.place), {}, {}
    local pixels = ev.camera:stroke{ points = drawn, size = ev.size }.pixels
    for i, pixel in ipairs(pixels) do
        local hit = ev.camera:pick{ scene = ev.scene, x = pixel[1], y = pixel[2], size = ev.size }
        if not hit or not rawequal(hit.mesh, one.mesh) then
            if i > 1 and #line > 1 then break end
        else
            line[#line + 1] = matrices.point(back, hit.position)
            if hit.vertex ~= vertices[#vertices] then vertices[#vertices + 1] = hit.vertex end
        end
    end
    local a, b = pixels[1], pixels[#pixels]
    local closed = #line == #pixels and (a[1] - b[1]) ^ 2 + (a[2] - b[2]) ^ 2 < near ^ 2
    if params.by == "edges" and #vertices > 1 then
        local route = one.mesh:path{ points = vertices, closed = closed and #vertices > 2 }
        return route:points(), route:is_closed()
    end
    if closed then table.remove(line) end
    return line, closed
end

-- The polyline that was drawn last, if it still exists.
local function last_of(self, scene)
    local object = self.last and meshes.object(scene, self.last)
    return object and scene:info(self.last).kind == "polyline" and object or nil
end

local function add(self, scene, one, points, closed)
    local name = meshes.unused_name(scene, one.name .. " line")
    scene:add(name, lissom.polyline{ points = points, closed = closed },
        { transform = one.place, style = { color = "#e05020", line_width = 3 } })
    self.last = name
end

local function forget(self) self.pixels = nil end

return lissom.tool{
    name = "line",
    help = "Draw over a mesh: a line on it. Shift: on from the last one. Backspace takes the last one away.",
    params = {
        by = { type = "choice", default = "surface", choices = { "surface", "edges" },
            help = "Over the faces, or along their edges." },
    },
    press = function(self, ev) self.pixels, self.goes_on = { { ev.x, ev.y } }, ev.shift end,
    drag = function(self, ev)
        if self.pixels then table.insert(self.pixels, { ev.x, ev.y }) end
    end,
    release = function(self, ev)
        local drawn = self.pixels
        forget(self)
        if not drawn or #drawn < 3 then return end
        local mesh = drawn_line.mesh(ev, drawn)
        local one = mesh and meshes.find(ev.scene, mesh)
        if not one then error("draw over a mesh", 0) end
        local points, closed = on_surface(ev, one, drawn, self.params)
        if #points < 2 then error("the line is too short, or hardly on the mesh: draw it longer", 0) end
        local last = self.goes_on and last_of(self, ev.scene)
        if not last or last:is_closed() then return add(self, ev.scene, one, points, closed) end
        local all = last:points()
        table.move(points, 1, #points, #all + 1, all)
        last:set_points(all)
    end,
    key = function(self, ev)
        if ev.key ~= "backspace" or self.pixels or not last_of(self, ev.scene) then return end
        ev.scene:remove(self.last)
        self.last = nil
    end,
    draw = function(self, view)
        if self.pixels and #self.pixels > 1 then view:outline{ pixels = self.pixels, width = 2 } end
    end,
    cancel = forget,
    deactivate = forget,
}
