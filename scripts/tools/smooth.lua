--- Smooths the surface under a brush.
--
-- Drag over it. With a selection, only that is smoothed. A deformation that was in progress ends with the
-- shape that it has. A pen smooths more, or under a larger brush, the harder it presses.
local lissom = require "lissom"
local brush = require "tools.support.brush"
local meshes = require "tools.support.meshes"

-- The share of a parameter that the pen presses for.
local function share(self, name, pressure) return self.params.pressure == name and pressure or 1 end

local function radius(self, pressure)
    return math.max(self.params.radius * share(self, "radius", pressure), 1)
end

-- Smooths the vertices under the brush since the last event, or the selected ones of them.
local function smooth(self, ev)
    local params = self.params
    self.pressure = ev.pressure
    for _, one in ipairs(self.brush:paint(ev, radius(self, ev.pressure))) do
        local selection = meshes.selection(one.mesh)
        local region = #selection > 0 and one.region:intersect(selection) or one.region
        if #region > 0 then
            meshes.end_deformation(ev.scene, one.mesh)
            one.mesh:smooth{ region = region, iterations = params.iterations,
                strength = params.strength * share(self, "strength", ev.pressure), boundary = params.boundary,
                keep_volume = params.keep_volume }
        end
    end
end

local function lift(self)
    self.brush:lift()
    self.pressure = nil
end

return lissom.tool{
    name = "smooth",
    help = "Drag over the surface to smooth it.",
    params = {
        radius = { type = "number", default = 30, min = 1, max = 300, unit = "pixels", help = "brush" },
        strength = { type = "number", default = 0.3, min = 0.01, max = 1,
            help = "How far a vertex goes towards the mean of its neighbours in a step." },
        iterations = { type = "integer", default = 2, min = 1, max = 50, help = "Steps at each place." },
        boundary = { type = "choice", default = "fixed", choices = { "fixed", "along" },
            help = "Open boundaries stay, or are smoothed along their loop." },
        pressure = { type = "choice", default = "strength", choices = { "strength", "radius", "none" },
            help = "The parameter that a pen's pressure scales; a mouse has the full value." },
        keep_volume = { type = "boolean", default = false, help = "Takes bumps away without shrinking." },
    },
    brush = brush.new(),
    press = smooth,
    drag = smooth,
    release = lift,
    move = function(self, ev) self.brush:move(ev) end,
    draw = function(self, view) self.brush:draw(view, radius(self, self.pressure or 1)) end,
    cancel = lift,
    deactivate = lift,
}
