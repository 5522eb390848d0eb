--- A brush in a tool's hand: a disk that is moved over the surface with the button down.
local brush = {}
brush.__index = brush

function brush.new() return setmetatable({}, brush) end

--- The cursor has moved.
function brush:move(ev) self.x, self.y = ev.x, ev.y end

--- What it has come over since it was here last: regions as ev:select finds them. `options` are others of
-- that.
function brush:paint(ev, radius, options)
    local here = { ev.x, ev.y }
    local search = { brush = { stroke = { self.last or here, here }, radius = radius } }
    for key, value in pairs(options or {}) do search[key] = value end
    self.last = here
    self:move(ev)
    return ev:select(search)
end

--- All that the stroke has come over: a region for each mesh. What was found before is not looked for again.
function brush:cover(ev, radius, options)
    self.covered = self.covered or {}
    local search = { known = {} }
    for key, value in pairs(options or {}) do search[key] = value end
    for _, region in pairs(self.covered) do table.insert(search.known, region) end
    for _, one in ipairs(self:paint(ev, radius, search)) do
        local old = self.covered[one.mesh]
        self.covered[one.mesh] = old and old:union(one.region) or one.region
    end
    return self.covered
end

--- The stroke has ended.
function brush:lift() self.last, self.covered = nil, nil end

function brush:draw(view, radius)
    if self.x then view:circle{ at = { self.x, self.y }, radius = radius } end
end

return brush
