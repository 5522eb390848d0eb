--- Draws partings: lines on the head from which hair flows away to both sides.
--
-- Drag over the head: a parting. A stroke that begins beside the chosen one is its tilt: draw it as hair
-- shall flow there. All of a side count together, so two of them, one near each end, tell how the tilt
-- changes along the line. With shift a stroke is a parting wherever it begins. Click a parting, or press tab,
-- to choose it; drag its handles: how far off the crest of the hair stands, and how high. Backspace takes its
-- tilt strokes away, delete the parting.
local lissom = require "lissom"
local curve_handles = require "tools.support.curve_handles"
local hair = require "tools.support.hair"
local vectors = require "vectors"

local beside = 0.02         -- metres from a parting in which its tilt strokes begin
local rise = 0.004          -- metres that the handle of a height of 0 stands above the skin

-- The chosen parting, else the last one; its place among them, and all.
local function chosen(self, one) return curve_handles.chosen(one, "dividing", self.curve) end

local function choose(self, curve)
    self.curve = curve
    curve_handles.show(self.params, "parting", curve)
end

-- The handles of a parting: the crest of its hair, and how high that is.
local function handles(one, curve)
    local here = curve_handles.place_on(one, curve:course(), 0.5)
    local options, metre = curve:options(), one.scalp:scale()
    local crest = vectors.plus(here.at, here.right, options.sigma * metre)
    local top = vectors.plus(crest, here.normal, (rise + 0.39 * options.height) * metre)
    return { { option = "sigma", base = here.at, way = here.right, at = crest },
        { option = "height", base = crest, way = here.normal, at = top } }
end

local function drag_handle(ev, one, curve, held)
    local length = curve_handles.slide(ev, one, held)
    if held.option == "height" then length = (length - rise) / 0.39 end
    local least = held.option == "sigma" and 0.003 or 0
    curve:set{ [held.option] = math.max(least, math.min(0.04, length)) }
end

-- What the drawn stroke means: a click chooses, a stroke is a tilt or a new parting.
local function finish(self, ev, one)
    local curve = chosen(self, one)
    if hair.is_click(self.pixels) then
        local other = hair.curve_at(ev, one, { kind = "dividing", preferred = curve })
        return other and choose(self, other)
    end
    local camera = hair.camera(ev.camera, one)
    local line = camera:stroke{ points = self.pixels, on = one.scalp, depth = "last", size = ev.size }.points
    local near = curve and hair.distance(curve:course(), line[1]) < beside * one.scalp:scale()
    if near and not ev.shift then
        curve:add_hint(line)
    else
        local options = curve_handles.options(self.params, "parting")
        options.points, options.name = line, "parting"
        self.curve = one.style:dividing(options)
    end
    hair.grow(ev.scene, one)
end

-- Which way hair flows beside a parting, as small arrows.
local function draw_tilt(view, one, curve)
    local tilt, course = curve:tilt(), curve:course()
    for i = 0, 6 do
        local here = curve_handles.place_on(one, course, i / 6)
        for _, side in ipairs{ "left", "right" } do
            local angle = math.rad(tilt[side].start + i / 6 * (tilt[side].finish - tilt[side].start))
            local away = (side == "left" and -1 or 1) * math.cos(angle)
            local sideways = vectors.plus({ 0, 0, 0 }, here.right, away)
            local way = vectors.plus(sideways, here.tangent, math.sin(angle))
            curve_handles.arrow(view, one, { at = here.at, way = way, normal = here.normal })
        end
    end
end

local function forget(self) self.held, self.pixels = nil, nil end

return lissom.tool{
    name = "parting",
    help = "Drag over the head: a parting; beside it: its tilt (shift: another parting). Handles, click, "
        .. "tab, backspace, delete.",
    params = hair.with_params{
        sigma = { type = "number", default = 14, min = 3, max = 40, unit = "millimetres", group = "parting",
            help = "How far from the line the crest of the hair is." },
        height = { type = "number", default = 7, min = 0, max = 40, unit = "millimetres", group = "parting",
            help = "How high the hair rises; the crest is 0.39 times as high." },
        separation = { type = "number", default = 0.3, min = 0, max = 1, group = "parting",
            help = "How strongly both sides are kept apart." },
        gap = { type = "number", default = 2.4, min = 0, max = 20, unit = "millimetres", group = "parting",
            help = "Width of the bare skin." },
    },
    press = function(self, ev)
        local one = hair.need(ev.scene, self.params)
        local curve = chosen(self, one)
        self.held = curve and curve_handles.pick(ev, one, handles(one, curve))
        self.pixels = { { ev.x, ev.y } }
    end,
    drag = function(self, ev)
        local one = hair.find(ev.scene, self.params)
        local curve = one and chosen(self, one)
        table.insert(self.pixels, { ev.x, ev.y })
        if not self.held or not curve then return end
        drag_handle(ev, one, curve, self.held)
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
        if ev.key ~= "backspace" and ev.key ~= "delete" then return end
        if ev.key == "delete" then curve:remove() else curve:remove_hints() end
        hair.grow(ev.scene, one)
    end,
    changed = function(self, ev)
        local one = hair.find(ev.scene, self.params)
        local curve = one and chosen(self, one)
        local changes = curve_handles.options(self.params, "parting", ev.parameter)
        if curve and next(changes) then curve:set(changes) end
        if one then hair.grow(ev.scene, one) end
    end,
    draw = function(self, view)
        local one = hair.find(view.scene)
        local curve = one and chosen(self, one)
        if self.pixels and not self.held then view:outline{ pixels = self.pixels, color = "#e04038" } end
        if one then hair.draw(view, one, curve) end
        if not curve then return end
        draw_tilt(view, one, curve)
        local look = { color = "#f0a040", width = 3 }
        for _, hint in ipairs(curve:hints()) do hair.line(view, one, hint, look) end
        curve_handles.draw(view, one, handles(one, curve))
    end,
    cancel = forget,
    deactivate = forget,
}
