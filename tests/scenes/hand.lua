--- A hand that uses a tool in a scene, at points of the world.
--
--     local h = hand.new("smooth", { box = lissom.shapes.box() })
--     h:drag({ 0, 0, 0.5 }, { 0.2, 0, 0.5 })
--     h.host:undo()
local lissom = require "lissom"

local hand = {}
hand.__index = hand

local size = { 1280, 960 }

--- A scene of named objects, seen from in front, where a unit is a hundred pixels, and a tool in it.
-- `objects` are objects by name, `options` those of lissom.camera, `places` (matrices by name) and `record`.
function hand.new(tool, objects, options)
    local self = setmetatable({ scene = lissom.scene{} }, hand)
    options = options or {}
    local names = {}
    for name in pairs(objects) do table.insert(names, name) end
    table.sort(names)
    for _, name in ipairs(names) do
        self.scene:add(name, objects[name], { transform = options.places and options.places[name] })
    end
    self.scene:clear_history()
    self.camera = lissom.camera{
        eye = options.eye or { 0, 0, 50 }, target = options.target, up = options.up, fov = options.fov,
        ortho = not options.fov and (options.ortho or 9.6) or nil,
    }
    self.host = lissom.tool_host{ scene = self.scene, camera = self.camera, size = size }
    if options.record then self.host:record():keep_journal() end
    return self:use(tool)
end

--- Takes the tool of a name, as if its file were loaded for the first time.
function hand:use(name)
    self.tool = lissom.load_tool(name)
    self.host:use(self.tool)
    return self
end

--- The pixel of a point, as the methods of the host take it, with other options of theirs.
function hand:at(point, options)
    local x, y = self.camera:project(point, size)
    local event = { x = x, y = y }
    for key, value in pairs(options or {}) do event[key] = value end
    return event
end

function hand:click(point, options) self.host:click(self:at(point, options)) end
function hand:press(point, options) self.host:press(self:at(point, options)) end
function hand:move(point, options) self.host:move(self:at(point, options)) end
function hand:release(point, options) self.host:release(self:at(point, options)) end

--- Presses at the first point, goes on over the others, `steps` (4) events each, and lets go at the last.
function hand:drag(points, options, steps)
    self:press(points[1], options)
    for i = 2, #points do
        local a, b = points[i - 1], points[i]
        for step = 1, steps or 4 do
            local t, between = step / (steps or 4), {}
            for axis = 1, 3 do between[axis] = a[axis] + t * (b[axis] - a[axis]) end
            self:move(between, options)
        end
    end
    self:release(points[#points], options)
end

function hand:key(...)
    for _, key in ipairs{ ... } do self.host:key{ key = key } end
end

--- Number of steps that can be undone.
function hand:steps() return self.scene:history().place end

--- Undoes all and does it again, to the bit; returns the hash of the beginning.
function hand:there_and_back()
    local last, steps = self.scene:hash(), self:steps()
    for _ = 1, steps do self.host:undo() end
    local first = self.scene:hash()
    for _ = 1, steps do self.host:redo() end
    assert(self.scene:hash() == last, "what was undone is done again to the bit")
    return first
end

--- The selected vertices of an object, as a list.
function hand:selected(name)
    local mesh = self.scene:get(name)
    local region = lissom.try(mesh.region, mesh, "selected")
    return region and region:vertices() or {}
end

return hand
