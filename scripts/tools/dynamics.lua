--- Shows how hair moves, to see whether a style holds.
--
-- While the button is down gravity and wind act; a drag turns the head, sideways about its own axis, up and
-- down to nod. Letting go puts everything back, or keeps the hair as it hangs.
local lissom = require "lissom"
local hair = require "tools.support.hair"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"
local vectors = require "vectors"

local turn_of_pixel = 0.35          -- degrees
local most = { 80, 40 }             -- degrees to a side, and of a nod
local pace = 240                    -- degrees a second at which the head follows the hand

local function times(v, s) return vectors.plus({ 0, 0, 0 }, v, s) end

-- ---- The objects

-- The name of the first visible strands of a scene, those of its style before others.
local function strands_name(scene, one)
    local own = one and one.name .. " hair"
    local first
    for _, name in ipairs(scene:names()) do
        local info = scene:info(name)
        if info.kind == "strands" and info.visible then
            if name == own then return name end
            first = first or name
        end
    end
    return first or error("no hair is to be seen: grow some first, as with the tool stream", 0)
end

-- The style whose head and ties hold the hair; without one a style without curves on the visible head.
local function style_of(scene, one)
    if one then return one.style end
    local subject = meshes.subject(scene)
    if not subject then error("no head, or no single one, is to be seen below the hair", 0) end
    return lissom.hairstyle(subject.mesh, { resolution = 5000 })
end

local function visible_places(scene)
    local places = {}
    for _, name in ipairs(scene:names()) do
        local info = scene:info(name)
        if info.visible then places[name] = info.transform end
    end
    return places
end

-- ---- The motion

-- All of a gesture: the dynamics, the strands that show it, and the turn of the head, in degrees.
local function begin(self, scene)
    local one, v = hair.find(scene), self.params
    local name = strands_name(scene, one)
    local strands, style = scene:get(name), style_of(scene, one)
    local run = { hair = name, places = visible_places(scene), scalp = style:scalp(),
        aim = { 0, 0 }, now = { 0, 0 } }
    local set = strands:guide_set{ count = math.min(v.guides, #strands), points = v.points }
    run.dynamics = set:dynamics{ head = style, stiffness = v.stiffness, hold = v.hold, cohesion = v.cohesion,
        wind = times(run.scalp:front(), -v.wind) }
    run.shown, run.shown_name = strands:copy(), meshes.unused_name(scene, name .. " in motion")
    scene:add(run.shown_name, run.shown, { transform = run.places[name] })
    run.places[run.shown_name] = run.places[name]
    scene:set(name, { visible = false })
    return run
end

-- The rotation of the head about its middle, in metres or in units of the mesh: a nod, then a turn.
local function rotation_of(run, metres)
    local center = times(run.scalp:center(), metres and run.scalp:unit() or 1)
    return matrices.product(matrices.rotation(run.scalp:up(), run.now[1], center),
        matrices.rotation(run.scalp:left(), run.now[2], center))
end

local function show(run, scene)
    local rotation = rotation_of(run, false)
    for name, place in pairs(run.places) do
        if name ~= run.hair then scene:set(name, { transform = matrices.product(place, rotation) }) end
    end
    run.dynamics:strands{ into = run.shown }
end

local function follow_hand(run, seconds)
    for i = 1, 2 do
        local off = run.aim[i] - run.now[i]
        run.now[i] = run.now[i] + math.max(-pace * seconds, math.min(pace * seconds, off))
    end
end

local function put_back(run, scene)
    for name, place in pairs(run.places) do
        if name ~= run.shown_name then scene:set(name, { transform = place }) end
    end
    scene:remove(run.shown_name)
    scene:set(run.hair, { visible = true })
end

return lissom.tool{
    name = "dynamics",
    help = "Hold the button to let gravity and wind act on hair; drag to turn the head. Letting go puts all "
        .. "back.",
    params = {
        wind = { type = "number", default = 0, min = 0, max = 20, unit = "m/s", help = "Wind in the face." },
        stiffness = { type = "number", default = 0.05, min = 0.005, max = 0.5, unit = "metres",
            help = "Length of a level strand that droops by an eighth of it: hair 0.05, with gel 0.2." },
        hold = { type = "number", default = 0, min = 0, max = 1,
            help = "Part of its weight that the style carries." },
        cohesion = { type = "number", default = 0.2, min = 0, max = 1,
            help = "How much locks stick together." },
        guides = { type = "integer", default = 200, min = 3, max = 2000, group = "guides",
            help = "Strands that move; the others follow them." },
        points = { type = "integer", default = 16, min = 4, max = 64, group = "guides",
            help = "Points of each strand; curls need more." },
        keep = { type = "boolean", default = false, help = "Letting go keeps the hair as it hangs." },
    },
    press = function(self, ev) self.state.run = begin(self, ev.scene) end,
    drag = function(self, ev)
        local run = self.state.run
        if not run then return end
        local across, down = ev.x - ev.start[1], ev.y - ev.start[2]
        for i, way in ipairs{ across, down } do
            run.aim[i] = math.max(-most[i], math.min(most[i], turn_of_pixel * way))
        end
    end,
    tick = function(self, ev)
        local run = self.state.run
        if not run or ev.seconds <= 0 then return end
        follow_hand(run, ev.seconds)
        run.dynamics:step(ev.seconds, { head = rotation_of(run, true) })
        show(run, ev.scene)
    end,
    release = function(self, ev)
        local run = self.state.run
        self.state.run = nil
        if not run or not self.params.keep then return false end
        put_back(run, ev.scene)
        run.dynamics:strands{ into = ev.scene:get(run.hair) }
    end,
    cancel = function(self) self.state.run = nil end,
}
