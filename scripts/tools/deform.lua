--- Bends a mesh by handles, while the rest of its surface follows.
--
-- Drag over the surface to select a part of it (shift adds) and press Enter: it becomes a handle, with a
-- gizmo. Select the part that shall hold its place and press p: it is pinned, a handle that stays. Then drag
-- the gizmo. Keys: w moves, e turns, r scales; x, y and z choose an axis; a number says how far, during the
-- drag or after it and then Enter. Click a handle or press tab to go to another; delete takes it away; f
-- finishes. v sets the pivot of turns and scaling: the middle of the selection, else the point of the surface
-- under the cursor, and beside the surface the middle of the handle again.
--
-- The handles live in the scene, in an object "... deformation" beside the mesh: they are undone and saved.
local lissom = require "lissom"
local brush = require "tools.support.brush"
local grip = require "tools.support.grip"
local handles = require "tools.support.handles"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"
local vectors = require "vectors"

local axes = { x = { 1, 0, 0 }, y = { 0, 1, 0 }, z = { 0, 0, 1 } }

-- The handle that the gizmo is at: none while there are but pinned ones; its number, and the list of all.
local function active(self, scene)
    local list = handles.list(scene)
    local number = handles.number(list, self.handle)
    local one = list[number]
    if one and self.pivot and self.pivot.handle ~= one.handle then self.pivot = nil end
    if one then self.grip:place(self.pivot and self.pivot.at or one.at) end
    return one, number, list
end

-- Pivot set by a key: nil for the middle of the handle.
local function pivot_at(ev, one)
    local selected = meshes.selection(one.mesh)
    if #selected == 0 then
        local hit = ev.x and ev:hit()
        return hit and hit.position or nil
    end
    local middle = { 0, 0, 0 }
    for _, v in ipairs(selected:vertices()) do
        local x, y, z = one.mesh:position(v)
        middle = vectors.plus(middle, { x, y, z }, 1 / #selected)
    end
    meshes.select(one.mesh, one.mesh:region{ vertices = {} })
    return matrices.point(one.place, middle)
end

-- The handle that has the vertex under the cursor.
local function handle_under(ev, list)
    local hit = ev:hit()
    for _, one in ipairs(hit and list or {}) do
        if rawequal(one.mesh, hit.mesh) and one.handle:region():contains(hit.vertex) then return one end
    end
    return nil
end

-- Selects the vertices under the brush.
local function paint(self, ev)
    for _, one in ipairs(self.brush:paint(ev, self.params.radius, { through = self.params.through })) do
        meshes.select(one.mesh, meshes.selection(one.mesh):union(one.region))
    end
end

-- Text about a new handle: the match of the mirrored side.
local function told_of_mirror(handle)
    if not handle:mirrored() then return nil end
    local residual = handle:mirror_residual()
    if residual.warning then return residual.warning end
    return string.format("mirrored; the sides differ by %.2f %% of the size, %.2f %% on "
        .. "average", 100 * residual.max, 100 * residual.mean)
end

-- Makes a handle of the selected vertices that no other has.
local function add_handle(self, scene)
    local one = meshes.subject(scene)
    local region = one and meshes.selection(one.mesh)
    if not region or #region == 0 then error("nothing is selected: drag over the surface first", 0) end
    local params, size = self.params, one.mesh:size()
    local deformer = handles.deformation(scene, one, region, params.reach * size)
    if not params.through then region = meshes.without_specks(region) end
    region = meshes.without_pinholes(region)
    for _, other in ipairs(deformer:handles()) do region = region:minus(other:region()) end
    local normal = axes[params.mirror]
    local mirror = normal
        and { point = one.mesh:bounds().center, normal = normal } or nil
    meshes.select(one.mesh, one.mesh:region{ vertices = {} })
    return deformer:add_handle(region, { falloff = params.falloff * size, mirror = mirror,
        weight = params.softness > 0 and 1 / params.softness or nil })
end

-- Solves for the present place of the handle, and reports the result.
local function finish(self, one)
    if self.params.avoid then
        one.deformer:solve{ avoid = true }
    else
        one.deformer:solve()
    end
    self.contacts = nil
    local report = one.deformer:report()
    local words = { string.format("stretch %.2f", report.stretch) }
    if report.volume_change then
        table.insert(words, string.format("volume %+.0f %%", 100 * report.volume_change))
    end
    local lines = { table.concat(words, "; ") }
    for _, warning in ipairs(report.warnings) do table.insert(lines, warning.message) end
    self.told = table.concat(lines, "\n")
end

-- The vertices of faces that run through one another, found anew when handles have moved.
local function contacts_of(self, one)
    local numbers = {}
    for _, handle in ipairs(one.deformer:handles()) do
        for _, row in ipairs(handle:matrix()) do table.insert(numbers, table.concat(row, " ")) end
    end
    local poses = table.concat(numbers, " ")
    local kept = self.contacts
    if not kept or kept.deformer ~= one.deformer or kept.poses ~= poses then
        kept = { deformer = one.deformer, poses = poses, region = one.deformer:contacts().region }
        self.contacts = kept
    end
    return kept.region
end

local gizmo_radius = 115        -- pixels

-- The place of a label that hides nothing of the gizmo at a point.
local function below_gizmo(view, at)
    local x, y, depth = view.camera:project(at, view.size)
    if x ~= x then return at end                    -- behind the camera
    return view.camera:unproject(x - gizmo_radius, y + gizmo_radius, depth, view.size)
end

local keys = {
    enter = function(self, scene)
        self.handle = add_handle(self, scene)
        self.told = told_of_mirror(self.handle)
    end,
    p = function(self, scene) handles.pin(add_handle(self, scene)) end,
    tab = function(self, _, one, number, list) self.handle = one and list[number % #list + 1].handle end,
    delete = function(_, scene, one) if one then handles.remove(scene, one) end end,
    f = function(_, scene, one) if one then meshes.end_deformation(scene, one.mesh) end end,
    v = function(self, _, one, _, _, ev)
        local at = one and pivot_at(ev, one)
        self.pivot = at and { handle = one.handle, at = at } or nil
    end,
}

return lissom.tool{
    name = "deform",
    help = "Drag over the surface, then Enter: a handle; p: pinned. Drag its gizmo. Keys: w(move) e(turn) "
        .. "r(scale), x y z, numbers, v(pivot), tab, delete, f(inish).",
    params = {
        radius = { type = "number", default = 30, min = 1, max = 300, unit = "pixels", help = "brush" },
        through = { type = "boolean", default = false,
            help = "The brush takes all that it covers, also hidden parts." },
        preview = { type = "choice", default = "large meshes", choices = { "large meshes", "always",
            "never" }, help = "Drags are quick, with some shear, and exact when they end." },
        contacts = { type = "boolean", default = false,
            help = "Shows the faces that run through one another, in red." },
        avoid = { type = "boolean", default = false,
            help = "Pushes apart parts that would run through one another, when a drag ends." },
        reach = { type = "number", default = 0, min = 0, max = 4, unit = "mesh sizes",
            group = "next handle", help = "How far around the first one it may move; 0: everywhere." },
        softness = { type = "number", default = 0, min = 0, max = 10, group = "next handle",
            help = "How far the surface may lag behind; 0: it is held exactly." },
        falloff = { type = "number", default = 0, min = 0, max = 2, unit = "mesh sizes",
            group = "next handle", help = "Within this distance the surface follows it, less and less." },
        mirror = { type = "choice", default = "none", choices = { "none", "x", "y", "z" },
            group = "next handle", help = "Mirrors it at the middle of the mesh: a second one follows." },
    },
    grip = grip.new(),
    brush = brush.new(),
    press = function(self, ev)
        self.told = nil
        local one, _, list = active(self, ev.scene)
        if one and self.grip:press(ev, one.handle:matrix()) then return end
        local points = {}
        for i, other in ipairs(list) do points[i] = other.at end
        local hit = #points > 0 and ev:pick{ kinds = "point", points = points, radius = 12 }
        local one_hit = hit and list[hit.index] or not ev.shift and handle_under(ev, list)
        if one_hit then
            self.handle = one_hit.handle
            return
        end
        for _, other in ipairs(ev.shift and {} or meshes.visible(ev.scene)) do
            meshes.select(other.mesh, other.mesh:region{ vertices = {} })
        end
        paint(self, ev)
    end,
    drag = function(self, ev)
        local one = active(self, ev.scene)
        if self.brush.last then return paint(self, ev) end
        if not one or not self.grip.gizmo:part() then return end
        handles.follow(one, self.grip.before, self.grip:drag(ev))
        if ev.late then return end
        handles.preview(one, self.params.preview)
    end,
    release = function(self, ev)
        local one = active(self, ev.scene)
        if one and self.grip.gizmo:part() then finish(self, one) end
        self.grip:release(one and one.handle:matrix())
        self.brush:lift()
    end,
    move = function(self, ev) self.brush:move(ev) end,
    key = function(self, ev)
        self.told = nil
        local one, number, list = active(self, ev.scene)
        local taken, motion
        if one then taken, motion = self.grip:key(ev, one.handle:matrix()) end
        if motion then
            handles.follow(one, self.grip.before, motion)
            finish(self, one)
            if not self.grip.gizmo:part() then self.grip:release(one.handle:matrix()) end
        elseif not taken and keys[ev.key] and not self.grip.gizmo:part() then
            keys[ev.key](self, ev.scene, one or list[#list], number, list, ev)
        end
    end,
    draw = function(self, view)
        local at_gizmo, _, list = active(self, view.scene)
        for _, one in ipairs(list) do
            local color = one.pinned and "#6f7b8c" or "#8860c8"
            view:region{ mesh = one.mesh, region = one.handle:region(), color = color }
            if one ~= at_gizmo then view:handle{ at = one.at, color = color } end
        end
        local contacts = at_gizmo and self.params.contacts and contacts_of(self, at_gizmo)
        if contacts and #contacts > 0 then
            view:region{ mesh = at_gizmo.mesh, region = contacts, color = "#d03a2c" }
        end
        if at_gizmo then self.grip:draw(view) end
        local busy = at_gizmo and (self.grip.gizmo:part() or self.grip:is_under(view))
        if at_gizmo and self.told then
            view:label{ at = below_gizmo(view, self.grip.gizmo:origin()), text = self.told }
        end
        if not busy then self.brush:draw(view, self.params.radius) end
    end,
    cancel = function(self)
        self.told, self.contacts = nil, nil
        self.grip:cancel()
        self.brush:lift()
    end,
    deactivate = function(self)
        self.told, self.contacts = nil, nil
        self.grip:cancel()
        self.brush:lift()
    end,
}
