--- Cuts a mesh in two. Both parts become objects of the scene; the mesh itself stays there, hidden.
--
-- by line: drag a line across the mesh; it is cut by the plane that is seen as that line.
-- by draw: draw a line across the mesh, from beside it to beside it, and it is cut through; or on it, back to
-- its start. by path: click points around the mesh, from all sides, and press Enter: it is cut along a smooth
-- line near the shortest path through them. Backspace takes the last point back. by region: Enter cuts along
-- the outline of the selection.
local lissom = require "lissom"
local drawn_line = require "tools.support.drawn_line"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"
local vectors = require "vectors"

-- The mesh under the middle of the drawn line, or the nearest one to that; and the point of the hit.
local function under_line(ev)
    for i = 0, 20 do
        local t = 0.5 + (i % 2 == 0 and 1 or -1) * i / 40
        local x, y = ev.start[1] + t * (ev.x - ev.start[1]), ev.start[2] + t * (ev.y - ev.start[2])
        local hit = ev.camera:pick{ scene = ev.scene, x = x, y = y, size = ev.size }
        local one = hit and meshes.find(ev.scene, hit.mesh)
        if one then return one, hit.position end
    end
    return nil
end

-- The mesh and the plane of the drawn line, in the mesh's own space; nil if it hits nothing.
local function plane_of(self, ev)
    local one, middle = under_line(ev)
    local along = one and { ev.x - ev.start[1], ev.y - ev.start[2] }
    if not one or math.abs(along[1]) + math.abs(along[2]) < 5 then return nil end
    local back = matrices.inverse(one.place)
    local function seen(pixel, depth)
        local origin, direction = ev.camera:ray(pixel[1], pixel[2], ev.size)
        return matrices.point(back, vectors.plus(origin, direction, depth))
    end
    local depth = vectors.length(vectors.plus(middle, ev.camera:eye(), -1))
    local a, b, c = seen(ev.start, 0), seen(ev.start, depth), seen({ ev.x, ev.y }, depth)
    local normal = vectors.cross(vectors.plus(b, a, -1), vectors.plus(c, a, -1))
    return one, { point = matrices.point(back, middle), normal = vectors.unit(normal),
        loops = self.params.all and "all" or "nearest" }
end

-- Cuts, and shows both parts instead of the mesh, with their edge until something else is done.
local function cut(self, scene, one, options)
    local first, second = one.mesh:cut(options)
    for _, part in ipairs{ first, second } do
        part:remove_region("selected")
        scene:add(meshes.unused_name(scene, one.name), part, { transform = one.place, style = one.style })
    end
    scene:set(one.name, { visible = false })
    self.edge = { mesh = first, place = one.place, list = first:boundaries() }
end

-- The mesh that points were clicked on; without the points, if it or its faces are gone.
local function clicked(self, scene)
    local one = self.mesh and meshes.find(scene, self.mesh)
    for _, vertex in ipairs(self.points) do
        if not one or vertex > #one.mesh then
            self.mesh, self.points = nil, {}
            return nil
        end
    end
    return one
end

local function forget(self) self.mesh, self.points, self.lines = nil, {}, nil end

return lissom.tool{
    name = "cut",
    help = "Drag a line across the mesh; by draw: any line across it, or round on it; by path: click around "
        .. "it, then Enter; by region: Enter.",
    params = {
        by = { type = "choice", default = "line", choices = { "line", "draw", "path", "region" } },
        all = { type = "boolean", default = false,
            help = "By line: cuts wherever the plane meets the mesh, not only at the line's middle." },
    },
    points = {},
    press = function(self, ev)
        self.edge = nil
        if self.params.by == "draw" then self.line = { { ev.x, ev.y } } end
        local hit = self.params.by == "path" and ev:pick{ kinds = { "vertex", "face" } }
        if not hit or (clicked(self, ev.scene) and not rawequal(hit.mesh, self.mesh)) then return end
        for _, vertex in ipairs(self.points) do
            if vertex == hit.vertex then return end
        end
        self.mesh = hit.mesh
        table.insert(self.points, hit.vertex)
    end,
    drag = function(self, ev)
        if self.params.by == "draw" and self.line then table.insert(self.line, { ev.x, ev.y }) end
        if self.params.by ~= "line" then return end
        if ev.late then return end
        self.line, self.lines = { ev.start, { ev.x, ev.y } }, nil
        local one, plane = plane_of(self, ev)
        if not one then return end
        local lines = lissom.try(one.mesh.cut, one.mesh, { plane = plane, preview = true })
        if lines then self.lines = { place = one.place, list = lines } end
    end,
    release = function(self, ev)
        local drawn = self.line
        self.line, self.lines = nil, nil
        if self.params.by == "draw" and drawn then
            local pixels = ev.camera:stroke{ points = drawn, size = ev.size, spacing = 6 }.pixels
            if #pixels < 3 then return end
            local line, one = drawn_line.loop(ev, pixels)
            cut(self, ev.scene, one, { path = line })
        end
        if self.params.by ~= "line" then return end
        local one, plane = plane_of(self, ev)
        if one then cut(self, ev.scene, one, { plane = plane }) end
    end,
    key = function(self, ev)
        if ev.key == "backspace" then table.remove(self.points) end
        if ev.key ~= "enter" or self.line then return end
        local one = clicked(self, ev.scene)
        if self.params.by == "path" and one and #self.points > 1 then
            cut(self, ev.scene, one, { path = one.mesh:path{ points = self.points, closed = true } })
            forget(self)
        elseif self.params.by == "region" then
            one = meshes.subject(ev.scene)
            if not one or #meshes.selection(one.mesh) == 0 then error("nothing is selected", 0) end
            cut(self, ev.scene, one, { region = meshes.selection(one.mesh) })
        end
    end,
    draw = function(self, view)
        if self.line then view:outline{ pixels = self.line } end
        local one, lines, place = clicked(self, view.scene), {}, nil
        if self.lines then
            lines, place = self.lines.list, self.lines.place
        elseif one and #self.points > 1 then
            lines, place = { one.mesh:path{ points = self.points, closed = #self.points > 2 } }, one.place
        elseif self.edge and meshes.find(view.scene, self.edge.mesh) then
            lines, place = self.edge.list, self.edge.place
        end
        for _, line in ipairs(lines) do
            local points = {}
            for i, point in ipairs(line:points()) do points[i] = matrices.point(place, point) end
            view:line{ points = points, closed = line:is_closed(), color = "#e05020", width = 3 }
        end
        for _, vertex in ipairs(self.points) do
            view:handle{ at = matrices.point(one.place, { one.mesh:position(vertex) }), color = "#e05020" }
        end
    end,
    cancel = function(self) self.line = nil; forget(self) end,
    deactivate = function(self) self.line, self.edge = nil, nil; forget(self) end,
}
