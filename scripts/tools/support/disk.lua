--- A disk over a surface, as far from its middle as a vertex is. Vertices lie in rings by their distance, so
-- that a smaller or larger disk does not look at all of them.
local disk = {}
disk.__index = disk

local rings = 1024

--- The disks around a vertex of a mesh.
function disk.around(mesh, vertex)
    local distances, farthest, near = mesh:distances{ from = vertex, method = "front" }, 0, {}
    for v = 1, #distances do
        local distance = distances[v]
        if distance > farthest and distance < math.huge then farthest = distance end
    end
    local self = setmetatable({ mesh = mesh, distances = distances, near = near }, disk)
    self.scale = farthest > 0 and rings / farthest or 0
    for ring = 0, rings do near[ring] = {} end
    for v = 1, #distances do
        local distance = distances[v]
        if distance < math.huge then
            local ring = near[math.floor(self.scale * distance)]
            ring[#ring + 1] = v
        end
    end
    return self
end

--- The region of the vertices that are no farther from the middle than this one: all, if that is out of
-- reach.
function disk:up_to(vertex)
    local radius, inside = self.distances[vertex], {}
    if radius == math.huge then return self.mesh:region{ all = true } end
    local last = math.floor(self.scale * radius)
    for ring = 0, last do
        for _, v in ipairs(self.near[ring]) do
            if ring < last or self.distances[v] <= radius then inside[#inside + 1] = v end
        end
    end
    return self.mesh:region{ vertices = inside }
end

return disk
