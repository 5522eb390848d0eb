--- Draws stream curves, which hair follows, and edits them by hint strokes.
--
-- by draw: a stroke that begins on the scalp is a new stream; one that ends at the tie of a tail goes into
-- it. With a stream chosen by a click, or begun at one, it is a hint: across the stream it cuts, from it to
-- elsewhere it goes on there, from it back to it it takes the place of the part between. Its reading stands
-- at the cursor; Alt takes the next reading. Seen from far beside the view that streams were drawn in (v:
-- from now on this one) hints change the depth: they are drawn on the surface that is shown. by pull: a drag
-- moves a stream there, at its first point the root over the scalp. by rub: smooths it. Keys: tab chooses the
-- next stream, delete removes it, m adds its mirror image, c a copy of it that begins at the cursor.
local curves = require "tools.support.curves"
local hair = require "tools.support.hair"
local hair_view = require "tools.support.hair_view"
local stream_hands = require "tools.support.stream_hands"

local draft_share = 0.1         -- of the strands, while the button is down

local function chosen(self, one)
    for _, curve in ipairs(one and hair.curves(one, "stream") or {}) do
        if curve == self.curve then return curve end
    end
    return nil
end

local function let_go(self) self.stroke = nil end

-- The stroke that a press begins, at the stream under the cursor or the chosen one.
local function begin(self, ev, one)
    local stroke, params = hair.new_stroke(ev, one), self.params
    local under, near = hair.curve_at(ev, one, { kind = "stream", preferred = chosen(self, one) })
    stroke.under, stroke.target = under, under or chosen(self, one)
    if params.by ~= "draw" and not under and stroke.target then
        near = hair.nearest(stroke.target:course(), hair.camera(ev.camera, one), ev.size, ev.x, ev.y)
        if not near or near.pixels > 20 then stroke.target = nil end
    end
    stroke.near = near
    if not stroke.target then return stroke end
    stroke.twin = params.symmetric and curves.partner(one, stroke.target) or nil
    stroke.before = stroke.target:points()
    if params.by ~= "draw" then
        stroke.before = stroke.target:course()
        near.point = hair.snapped(near, stroke.before)
        stroke.place = curves.place(stroke.before, near)
    end
    return stroke
end

local keys = {
    delete = function(self, one, curve)
        local twin = self.params.symmetric and curves.partner(one, curve)
        if twin then twin:remove() end
        curve:remove()
    end,
    m = function(self, one, curve)
        self.curve = one.style:add_stream{ points = curves.mirrored(one.scalp, curve:points()) }
    end,
    c = function(self, one, curve, ev)
        local hit = ev.x and one.scalp:head():pick(hair.camera(ev.camera, one):ray(ev.x, ev.y, ev.size))
        if not hit then error("press c with the cursor at the new root of the copy", 0) end
        local points = curves.copied(one.scalp, curve:points(), hit.position)
        self.curve = one.style:add_stream{ points = points }
    end,
}

return require("lissom").tool{
    name = "stream",
    help = "Draw from the scalp: a stream; to a tie: into it. Click one: strokes across or from it change "
        .. "it, Alt: otherwise.",
    params = hair.with_params{
        by = { type = "choice", default = "draw", choices = { "draw", "pull", "rub" } },
        stop = { type = "boolean", default = true, help = "Hair ends at the ends of the drawn streams." },
        lift = { type = "number", default = 20, min = 0, max = 60, unit = "millimetres",
            help = "Height of drawn hair off the skin; low for hair drawn to a tie." },
        symmetric = hair.symmetric,
        surface = { type = "choice", default = "auto", choices = { "auto", "strip", "ruled" },
            help = "Mode of hints: strip changes the look of a stream, ruled its depth, seen from aside." },
        reach = { type = "number", default = 0.05, min = 0.005, max = 0.3, unit = "metres",
            help = "How far along a stream a pull or a rub reaches." },
    },
    press = function(self, ev)
        self.stroke, self.advice = nil, nil
        self.stroke = begin(self, ev, hair.need(ev.scene, self.params))
    end,
    drag = function(self, ev)
        local stroke = self.stroke
        local one = stroke and hair.find(ev.scene, self.params)
        if not one or not hair.goes_on(stroke, ev) then return end
        if #stroke.pixels < 3 or hair.is_click(stroke.pixels) then return end
        stream_hands.follow(self, stroke, one, ev, draft_share)
    end,
    release = function(self, ev)
        local stroke = self.stroke
        local one = stroke and hair.find(ev.scene, self.params)
        if one and hair.is_click(stroke.pixels) then
            self.curve = stroke.under
            hair.forget_begun(stroke, ev.scene)
        elseif one and not stream_hands.follow(self, stroke, one, ev) then
            error(stroke.said, 0)
        elseif one and stroke.drafts then
            self.state.viewpoint = hair.camera(ev.camera, one)
            self.advice = hair.advice_after(ev, hair.is_guess(ev, one, stroke.pixels))
        end
        let_go(self)
    end,
    changed = function(self, ev)
        local one = hair.find(ev.scene, self.params)
        if one and (hair.params[ev.parameter] and ev.parameter ~= "field") then hair.grow(ev.scene, one) end
    end,
    key = function(self, ev)
        local one = not self.stroke and hair.find(ev.scene, self.params)
        local curve = chosen(self, one or nil)
        if one and ev.key == "v" then self.state.viewpoint = hair.camera(ev.camera, one) end
        if one and ev.key == "tab" then self.curve = hair.next_curve(ev, one, "stream", curve) end
        if not curve or not keys[ev.key] then return end
        keys[ev.key](self, one, curve, ev)
        hair.grow(ev.scene, one)
    end,
    draw = function(self, view)
        local one = hair.find(view.scene, self.params)
        if not one then return end
        if self.params.field then hair_view.field(view, one) end
        local stroke = self.stroke or {}
        local curve, pixels = stroke.target or chosen(self, one), stroke.pixels
        local under = hair_view.curves(view, one, "stream", curve, pixels ~= nil)
        if stroke.support then hair_view.support(view, one, stroke.support) end
        if pixels and #pixels > 1 then view:outline{ pixels = pixels, width = 2 } end
        local resting = not pixels
        local advice = resting and hair.advice(self, view)
        hair_view.say(view, stroke.said or advice or resting and hair_view.warning(view, one, under) or nil)
    end,
    cancel = let_go,
    deactivate = let_go,
}
