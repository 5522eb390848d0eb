--- Moves, turns and scales whole objects in the scene: their own coordinates stay.
--
-- Click an object, then drag a part of its gizmo. Keys: w moves, e turns, r scales; x, y and z choose an
-- axis; a number says how far, during the drag or after it and then Enter. Tab goes to the next object, h
-- puts it back to its first place.
local lissom = require "lissom"
local grip = require "tools.support.grip"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"
local vectors = require "vectors"

-- The columns of a place without their lengths: the directions of an object's own axes.
local function own_axes(place)
    local x = vectors.unit(matrices.direction(place, { 1, 0, 0 }))
    local y = matrices.direction(place, { 0, 1, 0 })
    y = vectors.unit(vectors.plus(y, x, -vectors.dot(x, y)))
    local z = vectors.cross(x, y)
    return { { x[1], y[1], z[1] }, { x[2], y[2], z[2] }, { x[3], y[3], z[3] } }
end

-- The object that is moved, with the gizmo in its middle; nil if there is none.
local function held(self, scene)
    local list = meshes.visible(scene)
    for _, one in ipairs(list) do
        if one.name == self.object or #list == 1 then
            self.object = one.name
            self.grip:place(meshes.ball(one), { axes = self.params.axes, local_axes = own_axes(one.place) })
            return one
        end
    end
    return nil
end

local function follow(self, scene, name, motion)
    scene:set(name, { transform = matrices.product(motion.matrix, self.grip.before) })
end

return lissom.tool{
    name = "transform",
    help = "Click an object and drag its gizmo. Keys: w move, e turn, r scale, x y z, numbers, tab, h(ome).",
    params = {
        axes = { type = "choice", default = "world", choices = { "world", "local", "view" },
            help = "Directions of the gizmo's axes." },
    },
    grip = grip.new(),
    press = function(self, ev)
        local one = held(self, ev.scene)
        if one and self.grip:press(ev, one.place) then return end
        local hit = ev:hit()
        local other = hit and meshes.find(ev.scene, hit.mesh)
        if other then self.object = other.name end
    end,
    drag = function(self, ev)
        local one = held(self, ev.scene)
        if one and self.grip.gizmo:part() then follow(self, ev.scene, one.name, self.grip:drag(ev)) end
    end,
    release = function(self, ev)
        local one = held(self, ev.scene)
        if self.grip.gizmo:part() then self.grip:release(one and one.place) end
    end,
    key = function(self, ev)
        local one = held(self, ev.scene)
        if not one then return end
        local taken, motion = self.grip:key(ev, one.place)
        if motion then
            follow(self, ev.scene, one.name, motion)
            self.grip:release(ev.scene:info(one.name).transform)
        elseif not taken and ev.key == "tab" then
            local list = meshes.visible(ev.scene)
            for i, other in ipairs(list) do
                if other.name == one.name then self.object = list[i % #list + 1].name break end
            end
        elseif not taken and ev.key == "h" then
            ev.scene:set(one.name, { transform = matrices.identity() })
        end
    end,
    draw = function(self, view)
        local one = held(self, view.scene)
        if not one then return end
        self.grip:draw(view)
        if #meshes.visible(view.scene) > 1 then view:label{ at = (meshes.ball(one)), text = one.name } end
    end,
    cancel = function(self) self.grip:cancel() end,
    deactivate = function(self) self.grip:cancel() end,
}
