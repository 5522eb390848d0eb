--- Draws a part of a shape anew: a silhouette, a ridge or any line of the surface.
--
-- The first stroke follows the line as it is; drawn along the outline of the shape it snaps to that. The
-- second one draws its new course: the surface follows as it is drawn, at its present depth. Both may run
-- either way. Ends that are drawn within 20 pixels of their old place stay there. A click begins anew.
local lissom = require "lissom"
local drawn_line = require "tools.support.drawn_line"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"
local vectors = require "vectors"

-- Takes the line as it is.
local function take_line(self, ev, pixels)
    local mesh = drawn_line.mesh(ev, pixels)
    if not mesh then error("draw along a line of the shape first", 0) end
    local line = drawn_line.on(ev, mesh, pixels)
    if #line < 3 then error("the line is too short, or hardly on the shape: draw it longer", 0) end
    self.line, self.mesh = line, mesh
end

-- The deformation of the surroundings of the line, with its length in the mesh's own space.
local function deformation(self, one)
    local back, length, from = matrices.inverse(one.place), 0, {}
    for i, point in ipairs(self.line) do
        point.at = matrices.point(back, point.hit.position)
        from[i] = point.hit.vertex
        if i > 1 then length = length + vectors.length(vectors.plus(point.at, self.line[i - 1].at, -1)) end
    end
    local around = { from = { vertices = from }, radius = self.params.reach * length }
    return lissom.deformer(one.mesh, { region = one.mesh:region{ geodesic = around } })
end

local function follow(self, ev, pixels)
    local one = meshes.find(ev.scene, self.mesh)
    if not one or #pixels < 2 then return nil end
    if not self.deformer then
        meshes.end_deformation(ev.scene, one.mesh)
        self.deformer = deformation(self, one)
    end
    local back = matrices.inverse(one.place)
    for i, pixel in ipairs(drawn_line.targets(self.line, pixels)) do
        local hit = self.line[i].hit
        local there = ev.camera:unproject(pixel[1], pixel[2], hit.depth, ev.size)
        self.deformer:constrain{ face = hit.face, triangle = hit.triangle, bary = hit.bary,
            position = matrices.point(back, there), weight = 100 }
    end
    return self.deformer
end

local function forget(self) self.pixels, self.line, self.mesh, self.deformer = nil, nil, nil, nil end

local function stroke(self, ev)
    return ev.camera:stroke{ points = self.pixels, size = ev.size, spacing = 10 }.pixels
end

return lissom.tool{
    name = "redraw",
    help = "Draw along an outline or ridge, then its new course. Click: begin anew.",
    params = {
        reach = { type = "number", default = 0.35, min = 0.05, max = 3, unit = "lengths of the line",
            help = "How far around the line the surface follows." },
    },
    press = function(self, ev) self.pixels, self.deformer = { { ev.x, ev.y } }, nil end,
    drag = function(self, ev)
        if not self.pixels then return end
        table.insert(self.pixels, { ev.x, ev.y })
        local deformer = self.line and #self.pixels > 3 and follow(self, ev, stroke(self, ev))
        if deformer then deformer:preview() end
    end,
    release = function(self, ev)
        if not self.pixels or #self.pixels < 3 then return forget(self) end
        local pixels = stroke(self, ev)
        if not self.line then
            take_line(self, ev, pixels)
            self.pixels = nil
            return
        end
        local deformer = follow(self, ev, pixels)
        if deformer then deformer:solve() end
        forget(self)
    end,
    draw = function(self, view)
        local list = {}
        for i, point in ipairs(self.line or {}) do list[i] = point.pixel end
        if #list > 1 then view:outline{ pixels = list, color = "#e8a33d", width = 3 } end
        if self.pixels and #self.pixels > 1 then view:outline{ pixels = self.pixels, width = 2 } end
    end,
    cancel = forget,
    deactivate = forget,
}
