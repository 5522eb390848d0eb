--- What the hand of the stream tool does with its strokes, by the tool's parameter `by`. The tool holds the
-- stroke, `pixels`; the stream that was there before, `target`, with its points `before` and its mirror image
-- `twin`; and those that the stroke makes, `drafts`.
local curves = require "tools.support.curves"
local hair = require "tools.support.hair"
local tie = require "tools.support.tie"
local vectors = require "vectors"

local stream_hands = {}

-- Puts the held stream and its mirror image at these points, or where they were.
local function put(self, one, points)
    self.target:set_points(points)
    if self.twin then self.twin:set_points(curves.mirrored(one.scalp, points)) end
end

local function put_back(self, one)
    if self.target then put(self, one, self.before) end
    for _, curve in ipairs(self.drafts or {}) do curve:remove() end
    self.drafts, self.support = nil, nil
end

-- A stream that is drawn, and its mirror image where the tool is symmetric; where they end at a tie they go
-- into it, and hair goes on there. Whether the first does.
local function add_streams(self, one, points, camera, size)
    local into = tie.led_into(one, points, camera, size)
    local lists = { into or points }
    if self.params.symmetric then
        local image = curves.mirrored(one.scalp, points)
        lists[2] = into and tie.led_into(one, image) or image
    end
    self.drafts = {}
    for i, list in ipairs(lists) do
        self.drafts[i] = one.style:add_stream{ points = list, stop = not into and self.params.stop }
    end
    return into ~= nil
end

local hands = {}

-- Each does what the stroke so far means, and says what that is.
function hands.draw(self, one, ev, camera)
    local given = { points = self.pixels, size = ev.size }
    local names, reading = {}, nil
    if self.target then
        names, reading = curves.readings(self.target, camera, ev.size, camera:stroke(given).pixels)
        names = names or {}
    end
    table.insert(names, "stream")
    local name = names[self.turn % #names + 1]
    if name ~= "stream" then
        self.support = curves.support(self.target, self.params.surface, camera, self.state.viewpoint)
        given.on = self.support
        curves.apply(self.target, name, camera:stroke(given).points)
        put(self, one, self.target:points())
    else
        given.on, given.lift = one.scalp, self.params.lift / 1000
        local into = add_streams(self, one, camera:stroke(given).points, camera, ev.size)
        if into then name = "stream into the tie" end
    end
    local hard = self.support and (self.support:end_on() > 1 / 3 and ": seen end-on, draw on the strip"
        or reading.pixels < 120 and ": come nearer" or not reading.sure and "?") or ""
    return name .. hard .. (#names > 1 and "  (Alt: " .. names[(self.turn + 1) % #names + 1] .. ")" or "")
end

function hands.pull(self, one, ev, camera)
    if not self.target then error("begin at a stream", 0) end
    local _, _, depth = camera:project(self.near.point, ev.size)
    local there = camera:unproject(ev.x, ev.y, depth, ev.size)
    if self.place == 0 then
        local hit = one.scalp:head():pick(camera:ray(ev.x, ev.y, ev.size))
        if not hit then error("the root stays on the head", 0) end
        there = hit.position
    end
    local by, reach = vectors.plus(there, self.near.point, -1), self.params.reach * one.scalp:scale()
    put(self, one, curves.pulled(self.before, self.place, by, reach))
    return self.place == 0 and "root" or "pull"
end

function hands.rub(self, one, ev, camera)
    if not self.target then error("begin at a stream", 0) end
    local points, reach = self.before, self.params.reach * one.scalp:scale()
    for _, pixel in ipairs(self.pixels) do
        local near = hair.nearest(points, camera, ev.size, pixel[1], pixel[2])
        if near and near.pixels < 30 then points = curves.rubbed(points, near.point, reach) end
    end
    put(self, one, points)
    return "rub"
end

--- The hand's work so far, anew from what was before, and a share of the hair after it; what is wrong with it
-- is told, not raised.
function stream_hands.follow(self, one, ev, share)
    put_back(self, one)
    local done, said = pcall(hands[self.params.by], self, one, ev, hair.camera(ev.camera, one))
    if done then done, said = hair.try_grow(ev.scene, one, share, said) end
    if not done then
        put_back(self, one)
        hair.grow(ev.scene, one, share)
    end
    said = hair.message(said)
    self.said = done and said or hair.refusal(said, self.target or #hair.curves(one) == 0)
    return done
end

return stream_hands
