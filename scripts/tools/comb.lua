--- Combs hair: a stroke through it says which way it shall flow.
--
-- Drag through hair as it shall grow, from its roots towards its tips. Streams that run beside the stroke
-- are bent, or a new one is added along it, whichever says it with the least change elsewhere; `by` has it
-- one way alone. Hair that flows so already does not change.
local lissom = require "lissom"
local hair = require "tools.support.hair"
local hair_view = require "tools.support.hair_view"

-- The stroke in the visible hair; an error if the head hides it.
local function drawn(self, ev, one)
    local strands = hair.strands(ev.scene, one)
    if not strands or #strands == 0 then error("there is no hair to comb: draw a stream first", 0) end
    local camera = hair.camera(ev.camera, one)
    local line = camera:stroke{ points = self.pixels, on = strands, size = ev.size }.points
    local hidden = 0
    for _, point in ipairs(line) do
        if hair.is_hidden(one, camera, ev.size, point) then hidden = hidden + 1 end
    end
    if hidden > #line / 2 then error("the hair there is behind the head: comb it from its side", 0) end
    return line
end

-- Report of a comb, in words.
local function told(report)
    if #report.bent == 0 and not report.added then return "hair flows so already" end
    local words = {}
    if #report.bent > 0 then table.insert(words, string.format("%d bent", #report.bent)) end
    if report.added then table.insert(words, "one added") end
    return string.format("%s, %.0f degrees off before, %.0f now", table.concat(words, ", "), report.before,
        report.after)
end

local function forget(self) self.pixels = nil end

return lissom.tool{
    name = "comb",
    help = "Drag through hair, from roots to tips: it flows so.",
    params = hair.with_params{
        by = { type = "choice", default = "least", choices = { "least", "bend", "add" },
            help = "least: the smallest change; streams are bent alone; or one is added." },
        reach = { type = "number", default = 0.04, min = 0.005, max = 0.2, unit = "metres",
            help = "How far from the stroke streams are bent." },
    },
    press = function(self, ev)
        hair.need(ev.scene, self.params)
        self.pixels, self.said = { { ev.x, ev.y } }, nil
    end,
    drag = function(self, ev) table.insert(self.pixels, { ev.x, ev.y }) end,
    release = function(self, ev)
        local one, pixels = hair.find(ev.scene, self.params), self.pixels
        if one and not hair.is_click(pixels) then
            local points = drawn(self, ev, one)
            self.said = told(one.style:comb{ points = points, by = self.params.by,
                reach = self.params.reach })
            hair.grow(ev.scene, one)
        end
        forget(self)
    end,
    changed = function(self, ev)
        local one = hair.find(ev.scene, self.params)
        if one and ev.parameter ~= "by" and ev.parameter ~= "reach" then hair.grow(ev.scene, one) end
    end,
    draw = function(self, view)
        local one = hair.find(view.scene, self.params)
        if not one then return end
        hair_view.curves(view, one, "stream", nil, self.pixels ~= nil)
        if self.pixels and #self.pixels > 1 then view:outline{ pixels = self.pixels, color = "#f0c040" } end
        if self.said and view.cursor then hair_view.say(view, self.said) end
    end,
    cancel = forget,
    deactivate = forget,
}
