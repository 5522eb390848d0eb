--- Puts a part onto another mesh: a nose, an ear, a horn.
--
-- The part is the selection of a mesh, or a mesh with a region called "region", such as lissom.part.save
-- writes. Press on the target, or on the part and drag it there: it follows the cursor as it will stand
-- there, with the loop that it is cut along and the energy of that. While the button is down the wheel turns
-- it, with shift it scales it. Let go: the best loop is sought, and the target has the part; that is one
-- step. If the part does not fit it stays at its last good place, and the reason is shown. With one mesh
-- alone a part is put onto itself.
local lissom = require "lissom"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"
local vectors = require "vectors"

local turn, growth = 5, 1.05                    -- of a line of the wheel: degrees, and a factor
local part_color = "#d9b38c"

-- The marked part of a mesh: its region and feature; nil if nothing is marked.
local function marked(one)
    local selected = meshes.selection(one.mesh)
    if #selected > 0 then return selected end
    return meshes.region(one.mesh, "region"), meshes.region(one.mesh, "feature")
end

-- The mesh that has the part: the one that was pressed, or that was so last, or the only one with a part.
local function find_part(self, scene, pressed)
    local found, last
    for _, one in ipairs(meshes.visible(scene)) do
        if marked(one) then
            if pressed and rawequal(one.mesh, pressed) then return one end
            if one.name == self.last then last = one end
            found = found or one
        end
    end
    return last or found
end

-- The object under the drag, and the point there in the space of its mesh.
local function under(self, ev)
    local hit, part = ev:hit(), self.part
    local alone = #meshes.visible(ev.scene) == 1
    local onto = hit and meshes.find(ev.scene, hit.mesh)
    if not onto or (rawequal(onto.mesh, part.mesh) and not alone) then return nil end
    return onto, matrices.point(matrices.inverse(onto.place), hit.position)
end

-- How the part stands: upright in the picture's space of both meshes, turned and scaled by the parameters.
local function placement(self, at)
    local up = self.params.up == "the view's" and self.up or self.params.up
    return { at = at, toward = up, up = up, angle = self.params.angle,
        scale = self.params.scale }
end

-- A new paste with the part at a point.
local function begun(self, onto, at)
    local region, feature = marked(self.part)
    return lissom.paste{ source = self.part.mesh, target = onto.mesh, region = region, feature = feature,
        clear = self.params.clear, normals = self.params.normals, placement = placement(self, at) }
end

-- Puts the part under the cursor, with its present loop; keeps the former place if it does not fit there.
local function follow(self, ev)
    local onto, at = under(self, ev)
    if not onto then return end
    local there, message
    if self.paste and rawequal(onto.mesh, self.onto.mesh) then
        local move = placement(self, at)
        move.search = false
        there, message = lissom.try(self.paste.move, self.paste, move)
    else
        there, message = lissom.try(begun, self, onto, at)
        if there then
            there:optimize()
            self.paste, self.onto = there, onto
        end
    end
    if there then
        self.at, self.angle, self.scale = at, self.params.angle, self.params.scale
        self.draft = nil
    end
    self.trouble = not there and { at = matrices.point(onto.place, at), text = tostring(message) } or nil
end

-- Gives the target the part: the preview, with the best loop there.
local function commit(self, scene)
    self.params.angle, self.params.scale = self.angle, self.scale
    local paste = begun(self, self.onto, self.at)
    paste:optimize()
    local mesh, problem = lissom.try(paste.merge, paste, {})
    if not mesh then
        self.trouble = { at = matrices.point(self.onto.place, self.at), text = tostring(problem) }
        return
    end
    for _, name in ipairs{ "selected", "region", "feature" } do mesh:remove_region(name) end
    scene:remove(self.onto.name)
    scene:add(self.onto.name, mesh, { transform = self.onto.place, style = self.onto.style })
end

-- The part in its present place, made when it is first seen there; one that does not fit has a reason
-- instead.
local function draft(self)
    if not self.draft then
        local mesh, boundary = lissom.try(self.paste.draft, self.paste)
        self.draft = mesh and { mesh = mesh, loop = boundary }
            or { loop = select(2, self.paste:loop()), trouble = tostring(boundary) }
    end
    return self.draft
end

local function forget(self)
    self.paste, self.onto, self.at, self.trouble, self.draft = nil, nil, nil, nil, nil
end

return lissom.tool{
    name = "paste",
    help = "Drag a part over another mesh; the wheel turns it, with shift it scales; let go to paste.",
    params = {
        angle = { type = "number", default = 0, min = -3600, max = 3600, unit = "degrees",
            help = "Turns the part on the surface, counter-clockwise; the wheel." },
        scale = { type = "number", default = 1, min = 0.01, max = 100,
            help = "Its size; shift and the wheel." },
        up = { type = "choice", default = "the view's",
            choices = { "the view's", "x", "y", "z", "-x", "-y", "-z" },
            help = "The direction of both meshes that stays upright." },
        clear = { type = "boolean", default = false, help = "Removes features of the target there." },
        normals = { type = "number", default = 0, min = 0, max = 1,
            help = "How much the loop minds the surface's directions; .1 to .3 for parts that overhang." },
    },
    press = function(self, ev)
        forget(self)
        self.up = ev.up
        local hit = ev:hit()
        self.part = find_part(self, ev.scene, hit and hit.mesh)
        if not self.part then error("nothing is selected: select the part first, or open one", 0) end
        self.last = self.part.name
        follow(self, ev)
    end,
    drag = function(self, ev)
        if not ev.late then follow(self, ev) end
    end,
    wheel = function(self, ev)
        if ev.shift then
            self.params.scale = math.max(0.01, math.min(100, self.params.scale * growth ^ ev.lines))
        else
            self.params.angle = (self.params.angle + turn * ev.lines) % 360
        end
        if self.paste then follow(self, ev) end
    end,
    release = function(self, ev)
        local trouble = self.trouble
        if self.paste then commit(self, ev.scene) end
        trouble = self.trouble or trouble
        forget(self)
        self.trouble = trouble
    end,
    draw = function(self, view)
        if self.trouble then view:label(self.trouble) end
        if not self.paste then return end
        local part, middle = draft(self), { 0, 0, 0 }
        local points = part.loop:points()
        for i, point in ipairs(points) do
            points[i] = matrices.point(self.onto.place, point)
            middle = vectors.plus(middle, points[i], 1 / #points)
        end
        if part.mesh then
            view:mesh{ mesh = part.mesh, transform = self.onto.place, color = part_color }
        else
            view:label{ at = points[1], text = part.trouble }
        end
        local search = self.paste:search()
        view:line{ points = points, closed = true, color = "#d06020", width = 4 }
        view:label{ at = middle, text = string.format("energy %.3g, misfit %.3f",
            search.energy[#search.energy], search.misfit[#search.misfit]) }
    end,
    cancel = forget,
    deactivate = forget,
}
