--- A brush in a tool's hand: a disk that is moved over the surface with the button down.
local brush = {}
brush.__index = brush

function brush.new() return setmetatable({}, brush) end

--- The cursor has moved.
function brush:move(ev) self.x, self.y = ev.x, ev.y end

--- Vertices under it since its last place: regions as ev:select finds them. `options` are others of that.
function brush:paint(ev, radius, options)
    local here = { ev.x, ev.y }
    local search = { brush = { stroke = { self.last or here, here }, radius = radius } }
    for key, value in pairs(options or {}) do search[key] = value end
    self.last = here
    self:move(ev)
    return ev:select(search)
end

local function join(regions, mesh, region)
    regions[mesh] = regions[mesh] and regions[mesh]:union(region) or region
end

--- All that the stroke has come over: a region for each mesh. Vertices found before, or found unseen by the
-- same camera, are not looked for again.
function brush:cover(ev, radius, options)
    self.covered = self.covered or {}
    if not rawequal(self.camera, ev.camera) then self.unseen, self.camera = {}, ev.camera end
    local search = { known = {} }
    for key, value in pairs(options or {}) do search[key] = value end
    for _, region in pairs(self.covered) do table.insert(search.known, region) end
    for _, region in pairs(self.unseen) do table.insert(search.known, region) end
    for _, one in ipairs(self:paint(ev, radius, search)) do
        join(self.covered, one.mesh, one.region)
        join(self.unseen, one.mesh, one.unseen)
    end
    return self.covered
end

--- The stroke has ended.
function brush:lift() self.last, self.covered, self.unseen, self.camera = nil, nil, nil, nil end

function brush:draw(view, radius)
    if self.x then view:circle{ at = { self.x, self.y }, radius = radius } end
end

return brush
