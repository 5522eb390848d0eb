--- What the tools of partings and tails have in common: a click chooses a curve, handles are dragged, and a
-- stroke does at once what it is taken for, which stands at the cursor; Alt takes the next reading.
--
-- A tool is made of its own part:
--   name, help, params        as of lissom.tool; parameters of the group `name` are the curve's numbers
--   kind, color               of the curves and of the stroke
--   handles(one, curve)       as curve_handles has them
--   slide(curve, held, metres)        takes a handle to a length from its base
--   readings(self, ev, one, curve)    what the stroke may mean, likeliest first: a list of { name =, act = },
--                             where act returns the curve that it has made, if any, and more to say
--   create(self, one, points)         a curve through points, with the tool's parameters
--   remember(curve), put_back(curve, before)    what strokes change of a curve, before one: points alone
--   keys                      functions of (curve, self, ev, one) by key
--   draw(view, one, curve)    what belongs to the chosen one
--   advise(one, curve, strands)       what to do next, after a stroke; nil where nothing is to be said
--
-- Where its parameter `symmetric` is set, the mirror image of a curve does what the curve does.
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

local function forget(self)
    self.held, self.pixels, self.target, self.before, self.draft = nil, nil, nil, nil, nil
    self.twin, self.twin_before, self.twin_draft, self.support, self.said = nil, nil, nil, nil, nil
end

local function put_back(self)
    if self.target then self.own.put_back(self.target, self.before) end
    if self.twin then self.own.put_back(self.twin, self.twin_before) end
    if self.draft then self.draft:remove() end
    if self.twin_draft then self.twin_draft:remove() end
    self.draft, self.twin_draft, self.support = nil, nil, nil
end

-- The mirror image of a curve where the tool is symmetric; nil where there is none.
local function twin_of(self, one, curve)
    return self.params.symmetric and curve and curves.partner(one, curve) or nil
end

-- What the stroke has done, done on the other side.
local function mirror(self, one)
    if not self.params.symmetric then return end
    local own = self.own
    if self.draft and not curves.is_middle(one, self.draft) then
        self.twin_draft = own.create(self, one, curves.mirrored(one.scalp, self.draft:points()))
    elseif self.twin and not self.draft then
        own.put_back(self.twin, curves.mirror_image(one.scalp, own.remember(self.target)))
    end
end

local function act(self, ev, one)
    local list = self.own.readings(self, ev, one, self.target)
    local reading, other = list[self.turn % #list + 1], list[(self.turn + 1) % #list + 1]
    local more = #list > 1 and "  (Alt: " .. other.name .. ")" or ""
    local done, made, said = pcall(reading.act)
    if not done then error(hair.message(made) .. more, 0) end
    self.draft = made
    mirror(self, one)
    return reading.name .. (said and ": " .. said or "") .. more
end

-- What the stroke so far means, done anew, and a share of the hair after it; what is wrong with it is told.
local function follow(self, ev, one, share)
    put_back(self)
    local done, said = pcall(act, self, ev, one)
    if done then done, said = hair.try_grow(ev.scene, one, share, said) end
    if not done then
        put_back(self)
        hair.grow(ev.scene, one, share)
    end
    said = hair.message(said)
    self.said = done and said or hair.refusal(said, self.target or #hair.curves(one) == 0)
    return done
end

local function drag_handle(self, ev, one)
    local length = curve_handles.slide(ev, one, self.held)
    self.own.slide(self.target, self.held, length)
    if self.twin then self.own.slide(self.twin, self.held, length) end
end

-- The target where it is still there; without one a stroke only makes something.
local function has_lost_target(self, one) return self.target and chosen(self, one) ~= self.target end

local calls = {}

function calls.press(self, ev)
    local one = hair.need(ev.scene, self.params)
    forget(self)
    self.target, self.advice = chosen(self, one), nil
    self.curve = self.target
    self.before = self.target and self.own.remember(self.target)
    self.twin = twin_of(self, one, self.target)
    self.twin_before = self.twin and self.own.remember(self.twin)
    self.held = self.target and curve_handles.pick(ev, one, self.own.handles(one, self.target))
    hair.begin_stroke(self, ev, one)
end

function calls.drag(self, ev)
    local one = self.pixels and hair.find(ev.scene, self.params)
    if not one or has_lost_target(self, one) then return end
    if not hair.goes_on(self, ev) then return end
    if self.held then
        drag_handle(self, ev, one)
        hair.grow(ev.scene, one, draft_share)
    elseif not hair.is_click(self.pixels) and #self.pixels > 2 then
        follow(self, ev, one, draft_share)
    end
end

function calls.release(self, ev)
    local one = self.pixels and hair.find(ev.scene, self.params)
    if not one or has_lost_target(self, one) then return forget(self) end
    if self.held then
        hair.grow(ev.scene, one)
    elseif hair.is_click(self.pixels) then
        local other = hair.curve_at(ev, one, { kind = self.own.kind, preferred = self.target })
        if other then choose(self, other) end
        hair.forget_begun(self, ev.scene)
    elseif not follow(self, ev, one) then
        error(self.said, 0)
    end
    self.curve = self.draft or self.curve
    if self.curve then choose(self, self.curve) end
    if self.own.advise and self.curve and not self.advice then
        self.advice = self.own.advise(one, self.curve, hair.strands(ev.scene, one))
    end
    hair.advise(self, ev, self.advice)
    forget(self)
end

function calls.key(self, ev)
    local one = not self.pixels and hair.find(ev.scene, self.params)
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
    local under = hair_view.curves(view, one, own.kind, curve, self.pixels ~= nil)
    if curve then own.draw(view, one, curve) end
    if self.support then hair_view.support(view, one, self.support) end
    local handle = curve and curve_handles.draw(view, one, own.handles(one, curve), self.held)
    if self.pixels and not self.held then
        view:outline{ pixels = self.pixels, color = own.color, width = 2 }
    end
    local resting = not self.pixels and not handle
    local advice = resting and hair.advice(self, view)
    hair_view.say(view, self.said or advice or resting and hair_view.warning(view, one, under) or nil)
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
