--- A gizmo in a tool's hand. Keys choose its action (w moves, e turns, r scales) and along which axis (x, y,
--- z); a drag moves it, with ctrl in steps and with shift a tenth as far; a typed number gives the exact
--- amount, during the drag, or after it and then Enter.
--
-- The moved object has a matrix, which the tool hands over; it moves it by the result of drag and key, a
-- lissom.GizmoMotion, beginning from grip.before.
local lissom = require "lissom"

local modes = { w = "move", e = "rotate", r = "scale" }
local usual_parts = { move = "move-x", rotate = "rotate-view", scale = "scale-all" }

local grip = {}
grip.__index = grip

function grip.new()
    return setmetatable({ gizmo = lissom.gizmo{ mode = "move" }, mode = "move", typed = "" }, grip)
end

local function same(a, b)
    for i = 1, 3 do
        for j = 1, 4 do
            if a[i][j] ~= b[i][j] then return false end
        end
    end
    return true
end

--- Puts it at a point of the world, unless it is held; `options` are those of gizmo:set.
function grip:place(point, options)
    if self.gizmo:part() then return end
    self.gizmo:set{ origin = point, mode = self.mode }
    if options then self.gizmo:set(options) end
end

--- Holds the part under the cursor; false if there is none.
function grip:press(ev, matrix)
    local part = self.gizmo:hit(ev.camera, ev.size, ev.x, ev.y)
    if not part then return false end
    self.gizmo:begin(part, ev.camera, ev.size, ev.x, ev.y)
    self.before, self.part, self.typed = matrix, part, ""
    return true
end

--- Motion of the drag so far.
function grip:drag(ev)
    if self.typed ~= "" then return self.gizmo:motion() end
    return self.gizmo:drag(ev.x, ev.y, { snap = ev.ctrl, precise = ev.shift })
end

--- Lets go; `matrix` is the final matrix of the moved object.
function grip:release(matrix)
    if self.gizmo:part() then self.gizmo:finish() end
    self.after, self.typed = matrix, ""
end

-- A number after a drag replaces it, unless the moved object has changed since: then it goes on from there.
local function typed_motion(self, ev, matrix)
    local number = tonumber(self.typed)
    if self.gizmo:part() then return number and self.gizmo:set_amount(number) end
    self.typed = ""
    if not number then return nil end
    if not (self.part and self.after and same(self.after, matrix)) then self.before = matrix end
    self.part = self.part or usual_parts[self.mode]
    self.gizmo:begin(self.part, ev.camera, ev.size, ev.x or 0, ev.y or 0)
    local motion = self.gizmo:set_amount(number)
    self.gizmo:finish()
    return motion
end

--- Whether a key was meant for it, and its motion then, or nil.
function grip:key(ev, matrix)
    local key, held = ev.key, self.gizmo:part()
    if key:find("^[%d.-]$") then
        self.typed = self.typed .. key
    elseif key == "backspace" and self.typed ~= "" then
        self.typed = self.typed:sub(1, -2)
    elseif key == "enter" and (self.typed ~= "" or held) then
        return true, typed_motion(self, ev, matrix)
    elseif modes[key] and not held then
        self.mode, self.part, self.after, self.typed = modes[key], nil, nil, ""
    elseif key:find("^[xyz]$") and not held then
        self.part, self.after, self.typed = self.mode .. "-" .. key, nil, ""
    else
        return false
    end
    return true, held and typed_motion(self, ev, matrix)
end

--- Lets go without an effect.
function grip:cancel()
    self.gizmo:cancel()
    self.typed, self.after = "", nil
end

--- Whether the cursor is over one of its parts, so that a press would hold that.
function grip:is_under(view)
    local cursor = view.cursor
    return cursor and self.gizmo:hit(view.camera, view.size, cursor[1], cursor[2]) ~= nil
end

--- The part that a typed number goes to: the one that is held, or the one chosen by a key.
function grip:chosen() return self.gizmo:part() or self.part end

function grip:draw(view)
    view:gizmo(self.gizmo, self:chosen())
    if self.typed ~= "" then view:label{ at = self.gizmo:origin(), text = self.typed } end
end

return grip
