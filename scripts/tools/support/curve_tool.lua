--- Common parts of the tools of partings and tails: a click chooses a curve, handles are dragged, and a
-- stroke has the effect of its reading at once, which stands at the cursor; Alt takes the next reading.
--
-- A tool is made of its own part:
--   name, help, params        as of lissom.tool; parameters of the group `name` are the curve's numbers
--   kind, color               of the curves and of the stroke
--   handles(one, curve)       as curve_handles has them
--   slide(curve, held, metres)        takes a handle to a length from its base
-- readings(self, stroke, ev, one) possible readings of the stroke, likeliest first: a list of { name =, act =
-- };
--                             act returns the curve that it has made, if any, and more to say
--   create(self, one, points)         a curve through points, with the tool's parameters
-- remember(curve), put_back(curve, before) the parts of a curve that strokes change, before one: points alone
--   keys                      functions of (curve, self, ev, one) by key
-- draw(view, one, curve) marks of the chosen one
-- advise(one, curve, strands) the next step, after a stroke; nil for none
--
-- If its parameter `symmetric` is set, the mirror image of a curve follows the curve.
--
-- A stroke is a value that the tool holds while the button is down: its `pixels`, the curve `target` with its
-- mirror image `twin`, both as they were `before` and `twin_before`; the handle that is `held`, if any; and
-- what it makes: the curves `draft` and `twin_draft`, the `support` that it is drawn on, what is `said` of
-- it, and the `advice` to be given after it.
local lissom = require "lissom"
local curve_handles = require "tools.support.curve_handles"
local curves = require "tools.support.curves"
local hair = require "tools.support.hair"
local hair_view = require "tools.support.hair_view"

local curve_tool = {}

local draft_share = 0.1         -- of the strands, while the button is down

-- The chosen curve, else the last one; its place among them, and all.
local function chosen(self, one) return curve_handles.chosen(one, self.own.kind, self.curve) end

local function choose(self, curve)
    self.curve = curve
    curve_handles.show(self.params, self.own.name, curve)
end

local function forget(self) self.stroke = nil end

local function put_back(own, stroke)
    if stroke.target then own.put_back(stroke.target, stroke.before) end
    if stroke.twin then own.put_back(stroke.twin, stroke.twin_before) end
    if stroke.draft then stroke.draft:remove() end
    if stroke.twin_draft then stroke.twin_draft:remove() end
    stroke.draft, stroke.twin_draft, stroke.support = nil, nil, nil
end

-- The mirror image of a curve if the tool is symmetric; nil if there is none.
local function twin_of(self, one, curve)
    return self.params.symmetric and curve and curves.partner(one, curve) or nil
end

-- Repeats the effect of the stroke on the other side.
local function mirror(self, stroke, one)
    if not self.params.symmetric then return end
    local own = self.own
    if stroke.draft and not curves.is_middle(one, stroke.draft) then
        stroke.twin_draft = own.create(self, one, curves.mirrored(one.scalp, stroke.draft:points()))
    elseif stroke.twin and not stroke.draft then
        own.put_back(stroke.twin, curves.mirror_image(one.scalp, own.remember(stroke.target)))
    end
end

local function act(self, stroke, ev, one)
    local list = self.own.readings(self, stroke, ev, one)
    local reading, other = list[stroke.turn % #list + 1], list[(stroke.turn + 1) % #list + 1]
    local more = #list > 1 and "  (Alt: " .. other.name .. ")" or ""
    local done, made, said = pcall(reading.act)
    if not done then lissom.error{ message = hair.message(made) .. more, code = hair.code(made) } end
    stroke.draft = made
    mirror(self, stroke, one)
    return reading.name .. (said and ": " .. said or "") .. more
end

-- Follows the stroke so far anew, with a share of the hair after it; its faults are told.
local function follow(self, stroke, ev, one, share)
    put_back(self.own, stroke)
    local done, said = pcall(act, self, stroke, ev, one)
    if done then done, said = hair.try_grow(ev.scene, one, share, said) end
    if not done then
        put_back(self.own, stroke)
        hair.grow(ev.scene, one, share)
    end
    stroke.said = hair.told(done, said, stroke.target or #hair.curves(one) == 0)
    return done
end

local function drag_handle(own, stroke, ev, one)
    local length = curve_handles.slide(ev, one, stroke.held)
    own.slide(stroke.target, stroke.held, length)
    if stroke.twin then own.slide(stroke.twin, stroke.held, length) end
end

-- The target if it still exists; without one a stroke only makes something.
local function has_lost_target(self, one)
    local target = self.stroke.target
    return target and chosen(self, one) ~= target
end

local calls = {}

function calls.press(self, ev)
    local one, own = hair.need(ev.scene, self.params), self.own
    forget(self)
    local stroke, target = hair.new_stroke(ev, one), chosen(self, one)
    self.advice, self.curve, stroke.target = nil, target, target
    stroke.before = target and own.remember(target)
    stroke.twin = twin_of(self, one, target)
    stroke.twin_before = stroke.twin and own.remember(stroke.twin)
    stroke.held = target and curve_handles.pick(ev, one, own.handles(one, target))
    self.stroke = stroke
end

function calls.drag(self, ev)
    local stroke = self.stroke
    local one = stroke and hair.find(ev.scene, self.params)
    if not one or has_lost_target(self, one) then return end
    if not hair.goes_on(stroke, ev) then return end
    if stroke.held then
        drag_handle(self.own, stroke, ev, one)
        hair.grow(ev.scene, one, draft_share)
    elseif not hair.is_click(stroke.pixels) and #stroke.pixels > 2 then
        follow(self, stroke, ev, one, draft_share)
    end
end

function calls.release(self, ev)
    local stroke = self.stroke
    local one = stroke and hair.find(ev.scene, self.params)
    if not one or has_lost_target(self, one) then return forget(self) end
    if stroke.held then
        hair.grow(ev.scene, one)
    elseif hair.is_click(stroke.pixels) then
        local other = hair.curve_at(ev, one, { kind = self.own.kind, preferred = stroke.target })
        if other then choose(self, other) end
        hair.forget_begun(stroke, ev.scene)
    elseif not follow(self, stroke, ev, one) then
        error(stroke.said, 0)
    end
    self.curve = stroke.draft or self.curve
    if self.curve then choose(self, self.curve) end
    local advice = stroke.advice
    if self.own.advise and self.curve and not advice then
        advice = self.own.advise(one, self.curve, hair.strands(ev.scene, one))
    end
    self.advice = hair.advice_after(ev, advice)
    forget(self)
end

function calls.key(self, ev)
    local one = not self.stroke and hair.find(ev.scene, self.params)
    local curve = one and chosen(self, one)
    if not curve then return end
    if ev.key == "tab" then return choose(self, hair.next_curve(ev, one, self.own.kind, curve)) end
    local action = self.own.keys and self.own.keys[ev.key]
    if ev.key ~= "delete" and not action then return end
    local twin = twin_of(self, one, curve)
    self.advice = nil
    for _, each in ipairs{ curve, twin } do
        if action then action(each, self, ev, one) else each:remove() end
    end
    hair.grow(ev.scene, one)
end

function calls.changed(self, ev)
    local one = hair.find(ev.scene, self.params)
    local curve = one and chosen(self, one)
    local changes = curve_handles.options(self.params, self.own.name, ev.parameter)
    local twin = twin_of(self, one, curve)
    for _, each in ipairs{ curve, twin } do
        if next(changes) then each:set(changes) end
    end
    if one and not hair.is_seen_only(ev.parameter) then hair.grow(ev.scene, one) end
end

function calls.draw(self, view)
    local one, own = hair.find(view.scene), self.own
    if not one then return end
    local curve = chosen(self, one)
    if self.params.field then hair_view.field(view, one) end
    local stroke = self.stroke or {}
    local under = hair_view.curves(view, one, own.kind, curve, stroke.pixels ~= nil)
    if curve then own.draw(view, one, curve) end
    if stroke.support then hair_view.support(view, one, stroke.support) end
    local handle = curve and curve_handles.draw(view, one, own.handles(one, curve), stroke.held)
    if stroke.pixels and not stroke.held then
        view:outline{ pixels = stroke.pixels, color = own.color, width = 2 }
    end
    local resting = not stroke.pixels and not handle
    local advice = resting and hair.advice(self, view)
    hair_view.say(view, stroke.said or advice or resting and hair_view.warning(view, one, under) or nil)
end

calls.cancel, calls.deactivate = forget, forget

--- The tool of its own part.
function curve_tool.make(own)
    own.params.symmetric = hair.symmetric
    local tool = { name = own.name, help = own.help, params = hair.with_params(own.params), own = own }
    for name, call in pairs(calls) do tool[name] = call end
    return lissom.tool(tool)
end

return curve_tool
