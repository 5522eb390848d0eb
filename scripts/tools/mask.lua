--- Paints on the scalp to make hair shorter, longer or thinner, and to part it.
--
-- Drag over the head. A style keeps its strokes; a later one paints over those before it, with a value of 1
-- it takes them away. A stroke of kind `parting` is a parting as wide as the brush. Delete takes away all
-- that was painted of the kind.
local lissom = require "lissom"
local hair = require "tools.support.hair"
local hair_view = require "tools.support.hair_view"
local vectors = require "vectors"

local colors = { length = "#40c060", density = "#4080e0", parting = "#e04038" }

-- The place on the outside of the head under the cursor; nil beside it.
local function under(ev, one)
    local origin, direction = hair.camera(ev.camera, one):ray(ev.x, ev.y, ev.size)
    local hit = one.scalp:head():pick(origin, direction)
    return hit and vectors.dot(hit.normal, direction) < 0 and hit.position or nil
end

local function radius_in(one, params) return params.radius * one.scalp:scale() end

-- Goes on to the place under the cursor, if that is far enough from the last one.
local function go_on(self, ev, one)
    local at = under(ev, one)
    local last = self.points[#self.points]
    if not at then return end
    local step = last and vectors.length(vectors.plus(at, last, -1)) or math.huge
    if step > radius_in(one, self.params) / 4 then table.insert(self.points, at) end
end

local function paint(self, one)
    local params = self.params
    if params.kind == "parting" then
        if #self.points < 2 then error("a parting is drawn as a line", 0) end
        return one.style:add_dividing{ points = self.points, gap = 2 * params.radius, name = "parting" }
    end
    return one.style:mask{ kind = params.kind, points = self.points, value = params.value,
        radius = params.radius, softness = params.softness }
end

-- The brush: a circle as wide as it is seen at the cursor.
local function draw_brush(self, view, one)
    local camera = hair.camera(view.camera, one)
    local at = one.scalp:head():pick(camera:ray(view.cursor[1], view.cursor[2], view.size))
    if not at then return end
    local rim = vectors.plus(at.position, vectors.unit(camera:up()), radius_in(one, self.params))
    local x, y = camera:project(at.position, view.size)
    local u, v = camera:project(rim, view.size)
    view:circle{ at = { x, y }, radius = math.sqrt((u - x) ^ 2 + (v - y) ^ 2) }
end

local function forget(self) self.points = nil end

return lissom.tool{
    name = "mask",
    help = "Drag over the head: paints length or density of hair, or a parting. Delete: takes it away.",
    params = hair.with_params{
        kind = { type = "choice", default = "length", choices = { "length", "density", "parting" },
            help = "Kind of the mask." },
        value = { type = "number", default = 0.5, min = 0, max = 4,
            help = "Factor of the length, or the density to 1; 1 erases." },
        radius = { type = "number", default = 0.02, min = 0.001, max = 0.2, unit = "metres",
            help = "Radius of the brush, on an average head." },
        softness = { type = "number", default = 0.5, min = 0, max = 1,
            help = "The share of the radius over which the brush fades." },
    },
    press = function(self, ev)
        local one = hair.need(ev.scene, self.params)
        self.points = {}
        go_on(self, ev, one)
        if #self.points == 0 then error("begin on the head", 0) end
    end,
    drag = function(self, ev)
        local one = self.points and hair.find(ev.scene, self.params)
        if one then go_on(self, ev, one) end
    end,
    release = function(self, ev)
        local one = self.points and hair.find(ev.scene, self.params)
        if one then
            paint(self, one)
            hair.grow(ev.scene, one)
        end
        forget(self)
    end,
    key = function(self, ev)
        local one = ev.key == "delete" and self.params.kind ~= "parting" and hair.find(ev.scene, self.params)
        if not one then return end
        one.style:clear_masks{ kind = self.params.kind }
        hair.grow(ev.scene, one)
    end,
    changed = function(self, ev)
        local one = hair.params[ev.parameter] and hair.find(ev.scene, self.params)
        if one then hair.grow(ev.scene, one) end
    end,
    draw = function(self, view)
        local one = hair.find(view.scene, self.params)
        if not one then return end
        local color = colors[self.params.kind]
        for _, mask in ipairs(one.style:masks()) do
            if mask.kind == self.params.kind then
                hair_view.line(view, one, mask.points, { color = color, width = 2 })
            end
        end
        if self.points then hair_view.line(view, one, self.points, { color = color, width = 4 }) end
        if view.cursor then draw_brush(self, view, one) end
    end,
    cancel = forget,
    deactivate = forget,
}
