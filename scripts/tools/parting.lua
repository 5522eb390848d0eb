--- Draws partings: lines on the head from which hair flows away to both sides.
--
-- Drag over the head: a parting. A stroke that begins beside the chosen one is its tilt: draw it as hair
-- shall flow there. All of a side count together, so two of them, one near each end, tell how the tilt
-- changes along the line. The reading of a stroke stands at the cursor; Alt takes the next one, with shift
-- any stroke is a parting. Click a parting, or press tab, to choose it; drag its handles: how far off the
-- crest of the hair stands (sigma), how high it is (height), and how firmly both sides are kept apart
-- (separation); one whose way is seen end-on is left out. Backspace takes its tilt strokes away, delete the
-- parting. With `symmetric` each parting beside the middle has a mirror image, which does the same.
local curve_handles = require "tools.support.curve_handles"
local curve_tool = require "tools.support.curve_tool"
local hair = require "tools.support.hair"
local hair_view = require "tools.support.hair_view"
local vectors = require "vectors"

local beside = 0.02         -- metres from a parting in which its tilt strokes begin
local rise = 0.004          -- metres that the handle of a height of 0 stands above the skin
local firm = 0.03           -- metres from the lowest to the highest place of the handle of the separation

-- The crest of its hair, how high that is, and at a quarter of the line how firmly both sides are apart.
local function handles(one, curve)
    local course, metre, options = curve:course(), one.scalp:scale(), curve:options()
    local here, other = curve_handles.place_on(one, course, 0.5), curve_handles.place_on(one, course, 0.25)
    local crest = vectors.plus(here.at, here.right, options.sigma * metre)
    local top = vectors.plus(crest, here.normal, (rise + 0.39 * options.height) * metre)
    local apart = vectors.plus(other.at, other.normal, (rise + firm * options.separation) * metre)
    return { { option = "sigma", base = here.at, way = here.right, at = crest },
        { option = "height", base = crest, way = here.normal, at = top },
        { option = "separation", base = other.at, way = other.normal, at = apart } }
end

local slides = {}
function slides.sigma(length) return math.max(0.003, math.min(0.04, length)) end
function slides.height(length) return math.max(0, math.min(0.04, (length - rise) / 0.39)) end
function slides.separation(length) return math.max(0, math.min(1, (length - rise) / firm)) end

local function create(self, one, points)
    local options = curve_handles.options(self.params, "parting")
    options.points, options.name = points, "parting"
    return one.style:add_dividing(options)
end

local function readings(self, stroke, ev, one)
    local camera, curve = hair.camera(ev.camera, one), stroke.target
    local given = { points = stroke.pixels, on = one.scalp, depth = "last", size = ev.size }
    local line = camera:stroke(given).points
    local list = { { name = "parting", act = function() return create(self, one, line) end } }
    local near = curve and hair.distance(curve:course(), line[1]) < beside * one.scalp:scale()
    if near and not ev.shift then
        table.insert(list, 1, { name = "tilt", act = function() curve:add_hint(line) end })
    end
    return list
end

-- Which way hair flows beside a parting, as small arrows, and the strokes that say so.
local function draw(view, one, curve)
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
    for _, hint in ipairs(curve:hints()) do
        hair_view.line(view, one, hint, { color = "#f0a040", width = 3 })
    end
end

return curve_tool.make{
    name = "parting",
    help = "Drag over the head: a parting; beside it: its tilt (Alt, shift: another parting). Handles, "
        .. "click, tab, backspace, delete.",
    kind = "dividing",
    color = "#e04038",
    params = {
        sigma = { type = "number", default = 14, min = 3, max = 40, unit = "millimetres", group = "parting",
            help = "How far from the line the crest of the hair is." },
        height = { type = "number", default = 7, min = 0, max = 40, unit = "millimetres", group = "parting",
            help = "How high the hair rises; the crest is 0.39 times as high." },
        separation = { type = "number", default = 0.3, min = 0, max = 1, group = "parting",
            help = "How strongly both sides are kept apart." },
        gap = { type = "number", default = 2.4, min = 0, max = 20, unit = "millimetres", group = "parting",
            help = "Width of the bare skin." },
    },
    handles = handles,
    slide = function(curve, held, length) curve:set{ [held.option] = slides[held.option](length) } end,
    readings = readings,
    create = create,
    remember = function(curve) return curve:hints() end,
    put_back = function(curve, hints)
        curve:remove_hints()
        for _, hint in ipairs(hints) do curve:add_hint(hint) end
    end,
    keys = { backspace = function(curve) curve:remove_hints() end },
    draw = draw,
}
