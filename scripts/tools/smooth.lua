--- Smooths the surface under a brush.
--
-- Drag over it. With a selection, only that is smoothed. A deformation that was in progress ends with the
-- shape that it has.
local lissom = require "lissom"
local brush = require "tools.support.brush"
local meshes = require "tools.support.meshes"

-- Smooths the vertices under the brush since the last event, or the selected ones of them.
local function smooth(self, ev)
    local params = self.params
    for _, one in ipairs(self.brush:paint(ev, params.radius)) do
        local selection = meshes.selection(one.mesh)
        local region = #selection > 0 and one.region:intersect(selection) or one.region
        if #region > 0 then
            meshes.end_deformation(ev.scene, one.mesh)
            one.mesh:smooth{ region = region, iterations = params.iterations, strength = params.strength,
                boundary = params.boundary, keep_volume = params.keep_volume }
        end
    end
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
        keep_volume = { type = "boolean", default = false, help = "Takes bumps away without shrinking." },
    },
    brush = brush.new(),
    press = smooth,
    drag = smooth,
    release = function(self) self.brush:lift() end,
    move = function(self, ev) self.brush:move(ev) end,
    draw = function(self, view) self.brush:draw(view, self.params.radius) end,
    cancel = function(self) self.brush:lift() end,
    deactivate = function(self) self.brush:lift() end,
}
