--- Draws ponytails: hair that is gathered in a tie and goes on along a spine.
--
-- Drag from the head away: the spine of a tail. Drag round it: the tie, there and as wide. Drag along it, on
-- either side: how the tail swells. A stroke that begins at the spine, or cuts it, changes it as in the
-- tool stream: seen from aside, a quarter turn away (v: from this view on), its depth. The reading of a
-- stroke stands at the cursor; Alt takes the next one, and with shift any stroke is a spine. Click a tail, or
-- press tab, to choose it; drag its handles: start and end of the part in which hair is drawn into the tie,
-- and the strength. Delete removes it, backspace the strokes round and along it. With `symmetric` each tail
-- beside the middle has a mirror image, which does the same. If hair misses the tie, g draws streams into it
-- from all around.
local curve_handles = require "tools.support.curve_handles"
local curve_tool = require "tools.support.curve_tool"
local hair = require "tools.support.hair"
local tail = require "tools.support.tail"

local function create(self, one, spine)
    local options = curve_handles.options(self.params, "ponytail")
    options.spine, options.name = spine, "ponytail"
    return one.style:add_ponytail(options)
end

local function new_tail(self, stroke, ev, one, in_middle)
    local curve = create(self, one, tail.spine(ev, one, stroke.pixels, in_middle))
    self.state.viewpoint = hair.camera(ev.camera, one)
    stroke.advice = not in_middle and hair.guessed or nil
    return curve
end

local function readings(self, stroke, ev, one)
    local is_change = stroke.target and not ev.shift
    local list = is_change and tail.readings(self.state.viewpoint, stroke, ev, one) or {}
    if tail.is_in_middle(ev, one, stroke.pixels) then
        table.insert(list, { name = "tail in the middle", act = function()
            return new_tail(self, stroke, ev, one, true)
        end })
    end
    table.insert(list, { name = "tail", act = function() return new_tail(self, stroke, ev, one) end })
    return list
end

return curve_tool.make{
    name = "ponytail",
    help = "Drag from the head away: a spine; round it: the tie; along it: how it swells; from it or across: "
        .. "another spine (Alt: otherwise, shift: another tail). g gathers hair into it. Handles, click, "
        .. "tab, backspace, delete.",
    kind = "ponytail",
    color = "#b060d0",
    params = {
        tightness = { type = "number", default = 0.6, min = 0, max = 1, group = "ponytail",
            help = "How firmly hair is drawn into the tie." },
        fullness = { type = "number", default = 1, min = 0, max = 3, group = "ponytail",
            help = "Without profiles: the tail swells by as many radii." },
        length = { type = "number", default = 0.6, min = 0.01, max = 1.5, unit = "metres", group = "hair",
            help = "Length of the strands up to the tie, on an average head." },
    },
    handles = tail.handles,
    slide = tail.drag,
    readings = readings,
    create = create,
    remember = function(curve)
        local profiles = curve:profiles()
        return { spine = curve:points(), section = curve:section(), profiles = profiles }
    end,
    put_back = function(curve, before) curve:set(before) end,
    keys = {
        backspace = function(curve) curve:set{ section = {}, profiles = { {}, {} } } end,
        g = function(curve, _, _, one) tail.gather(one, curve) end,
        v = function(_, self, ev, one) self.state.viewpoint = hair.camera(ev.camera, one) end,
    },
    draw = tail.draw,
    advise = function(one, _, strands)
        if strands and tail.share(one, strands) < 0.85 then return "hair misses the tie: g gathers it" end
    end,
}
