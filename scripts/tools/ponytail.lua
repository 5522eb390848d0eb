--- Draws ponytails: hair that is gathered in a tie and goes on along a spine.
--
-- Drag from the head away: the spine of a tail. Drag round it: the tie, there and as wide. Drag along it, on
-- either side: how the tail swells. With shift a stroke is a spine wherever it begins. Click a tail, or press
-- tab, to choose it; drag its handles: from where to where hair is drawn into the tie, and how firmly. Delete
-- takes it away.
local lissom = require "lissom"
local curve_handles = require "tools.support.curve_handles"
local hair = require "tools.support.hair"
local tail = require "tools.support.tail"

-- The chosen tail, else the last one; its place among them, and all.
local function chosen(self, one) return curve_handles.chosen(one, "ponytail", self.curve) end

local function choose(self, curve)
    self.curve = curve
    curve_handles.show(self.params, "ponytail", curve)
end

-- What the drawn stroke means: a click chooses, a stroke is a section or a profile, or a new spine.
local function finish(self, ev, one)
    local curve = chosen(self, one)
    if hair.is_click(self.pixels) then
        local other = hair.curve_at(ev, one, { kind = "ponytail", preferred = curve })
        return other and choose(self, other)
    end
    local meant = curve and not ev.shift and tail.reading(ev, one, curve:course(), self.pixels)
    if meant then
        local points = tail.on_spine(ev, one, curve:course(), self.pixels, meant == "section")
        curve:set(meant == "section" and { section = points }
            or { profiles = tail.with_profile(curve, points) })
    else
        local options = curve_handles.options(self.params, "ponytail")
        options.spine, options.name = tail.spine(ev, one, self.pixels), "ponytail"
        self.curve = one.style:ponytail(options)
    end
    hair.grow(ev.scene, one)
end

local function forget(self) self.held, self.pixels = nil, nil end

return lissom.tool{
    name = "ponytail",
    help = "Drag from the head away: a spine; round it: the tie; along it: how it swells (shift: another). "
        .. "Handles, click, tab, delete.",
    params = hair.with_params{
        tightness = { type = "number", default = 0.6, min = 0, max = 1, group = "ponytail",
            help = "How firmly hair is drawn into the tie." },
        fullness = { type = "number", default = 1, min = 0, max = 3, group = "ponytail",
            help = "Without profiles: the tail swells by as many radii." },
        length = { type = "number", default = 0.6, min = 0.01, max = 1.5, unit = "metres", group = "hair",
            help = "Of the strands up to the tie, on an average head." },
    },
    press = function(self, ev)
        local one = hair.need(ev.scene, self.params)
        local curve = chosen(self, one)
        self.held = curve and curve_handles.pick(ev, one, tail.handles(one, curve))
        self.pixels = { { ev.x, ev.y } }
    end,
    drag = function(self, ev)
        local one = hair.find(ev.scene, self.params)
        local curve = one and chosen(self, one)
        table.insert(self.pixels, { ev.x, ev.y })
        if not self.held or not curve then return end
        tail.drag(curve, self.held, curve_handles.slide(ev, one, self.held))
        hair.grow(ev.scene, one, 0.2)
    end,
    release = function(self, ev)
        local one = hair.find(ev.scene, self.params)
        local curve = one and chosen(self, one)
        if one and not self.held then
            finish(self, ev, one)
        elseif curve then
            choose(self, curve)
            hair.grow(ev.scene, one)
        end
        forget(self)
    end,
    key = function(self, ev)
        local one = hair.find(ev.scene, self.params)
        if not one or self.pixels then return end
        local curve, i, list = chosen(self, one)
        if not curve then return end
        if ev.key == "tab" then return choose(self, list[i % #list + 1]) end
        if ev.key ~= "delete" then return end
        curve:remove()
        hair.grow(ev.scene, one)
    end,
    changed = function(self, ev)
        local one = hair.find(ev.scene, self.params)
        local curve = one and chosen(self, one)
        local changes = curve_handles.options(self.params, "ponytail", ev.parameter)
        if curve and next(changes) then curve:set(changes) end
        if one then hair.grow(ev.scene, one) end
    end,
    draw = function(self, view)
        local one = hair.find(view.scene)
        local curve = one and chosen(self, one)
        if self.pixels and not self.held then view:outline{ pixels = self.pixels, color = "#b060d0" } end
        if one then hair.draw(view, one, curve) end
        if not curve then return end
        tail.draw(view, one, curve)
        curve_handles.draw(view, one, tail.handles(one, curve))
    end,
    cancel = forget,
    deactivate = forget,
}
