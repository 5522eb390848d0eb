--- Hands of the stream tool for its strokes, by the tool's parameter `by`. A stroke is a value: its `pixels`;
-- the stream that was there before, `target`, with its points `before` and its mirror image `twin`; and its
-- results: the streams `drafts`, the `support` that it is drawn on, and the text `said` about it. The tool
-- itself is only read.
local curves = require "tools.support.curves"
local hair = require "tools.support.hair"
local tie = require "tools.support.tie"
local vectors = require "vectors"

local stream_hands = {}

-- Puts the held stream and its mirror image at these points, or back to their old ones.
local function put(stroke, one, points)
    stroke.target:set_points(points)
    if stroke.twin then stroke.twin:set_points(curves.mirrored(one.scalp, points)) end
end

local function put_back(stroke, one)
    if stroke.target then put(stroke, one, stroke.before) end
    for _, curve in ipairs(stroke.drafts or {}) do curve:remove() end
    stroke.drafts, stroke.support = nil, nil
end

-- Adds a drawn stream, and its mirror image if the tool is symmetric; streams that end at a tie go into it,
-- and hair goes on there. Whether the first does.
local function add_streams(params, stroke, one, points, camera, size)
    local into = tie.led_into(one, points, camera, size)
    local lists = { into or points }
    if params.symmetric then
        local image = curves.mirrored(one.scalp, points)
        lists[2] = into and tie.led_into(one, image) or image
    end
    stroke.drafts = {}
    for i, list in ipairs(lists) do
        stroke.drafts[i] = one.style:add_stream{ points = list, stop = not into and params.stop }
    end
    return into ~= nil
end

local hands = {}

-- Each follows the reading of the stroke so far, and returns a text about it.
function hands.draw(self, stroke, one, ev, camera)
    local given = { points = stroke.pixels, size = ev.size }
    local names, reading = {}, nil
    if stroke.target then
        names, reading = curves.readings(stroke.target, camera, ev.size, camera:stroke(given).pixels)
        names = names or {}
    end
    table.insert(names, "stream")
    local name = names[stroke.turn % #names + 1]
    if name ~= "stream" then
        stroke.support = curves.support(stroke.target, self.params.surface, camera, self.state.viewpoint)
        given.on = stroke.support
        curves.apply(stroke.target, name, camera:stroke(given).points)
        put(stroke, one, stroke.target:points())
    else
        given.on, given.lift = one.scalp, self.params.lift / 1000
        local into = add_streams(self.params, stroke, one, camera:stroke(given).points, camera, ev.size)
        if into then name = "stream into the tie" end
    end
    local hard = stroke.support and (stroke.support:end_on() > 1 / 3 and ": seen end-on, draw on the strip"
        or reading.pixels < 120 and ": come nearer" or not reading.sure and "?") or ""
    return name .. hard .. (#names > 1 and "  (Alt: " .. names[(stroke.turn + 1) % #names + 1] .. ")" or "")
end

function hands.pull(self, stroke, one, ev, camera)
    if not stroke.target then error("begin at a stream", 0) end
    local _, _, depth = camera:project(stroke.near.point, ev.size)
    local there = camera:unproject(ev.x, ev.y, depth, ev.size)
    if stroke.place == 0 then
        local hit = one.scalp:head():pick(camera:ray(ev.x, ev.y, ev.size))
        if not hit then error("the root stays on the head", 0) end
        there = hit.position
    end
    local by, reach = vectors.plus(there, stroke.near.point, -1), self.params.reach * one.scalp:scale()
    put(stroke, one, curves.pulled(stroke.before, stroke.place, by, reach))
    return stroke.place == 0 and "root" or "pull"
end

function hands.rub(self, stroke, one, ev, camera)
    if not stroke.target then error("begin at a stream", 0) end
    local points, reach = stroke.before, self.params.reach * one.scalp:scale()
    for _, pixel in ipairs(stroke.pixels) do
        local near = hair.nearest(points, camera, ev.size, pixel[1], pixel[2])
        if near and near.pixels < 30 then points = curves.rubbed(points, near.point, reach) end
    end
    put(stroke, one, points)
    return "rub"
end

--- The hand's work so far, anew from the former state, and a share of the hair after it; faults are told, not
-- raised.
function stream_hands.follow(self, stroke, one, ev, share)
    put_back(stroke, one)
    local done, said = pcall(hands[self.params.by], self, stroke, one, ev, hair.camera(ev.camera, one))
    if done then done, said = hair.try_grow(ev.scene, one, share, said) end
    if not done then
        put_back(stroke, one)
        hair.grow(ev.scene, one, share)
    end
    stroke.said = hair.told(done, said, stroke.target or #hair.curves(one) == 0)
    return done
end

return stream_hands
