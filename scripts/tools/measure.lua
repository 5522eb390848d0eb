--- Measures by clicked points, in the unit of the world.
--
-- distance: two points, along a straight line. surface: two points of a mesh, over its surface. angle: three
-- points, the second at its vertex. object: area and volume of the clicked object. The next click begins
-- anew; backspace takes the last point back, d all. Points stay on the surface when it moves.
local lissom = require "lissom"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"
local vectors = require "vectors"

local wanted = { distance = 2, surface = 2, angle = 3, object = 1 }
local color = "#1878c0"

-- A mesh as it stands in the world.
local function in_world(one)
    local copy = one.mesh:copy()
    local positions = copy:positions()
    for i = 1, #positions, 3 do
        local point = matrices.point(one.place, { positions[i], positions[i + 1], positions[i + 2] })
        positions[i], positions[i + 1], positions[i + 2] = point[1], point[2], point[3]
    end
    if matrices.mirrors(one.place) then copy:flip() end
    return copy
end

-- Weighs the results of f for the corners of the triangle that a point was clicked in.
local function mean(point, f)
    local sum = 0
    for i = 1, 3 do sum = sum + point.bary[i] * f(point.triangle[i]) end
    return sum
end

-- Present positions of the points, and their meshes, without points of meshes that are gone or have other
-- vertices.
local function located(self, scene)
    local places, ones = {}, {}
    for _, point in ipairs(self.points) do
        local one = meshes.find(scene, point.mesh)
        local a, b, c = point.triangle[1], point.triangle[2], point.triangle[3]
        if one and math.max(a, b, c) <= #one.mesh then
            local at = {}
            for axis = 1, 3 do
                at[axis] = mean(point, function(v) return (select(axis, one.mesh:position(v))) end)
            end
            table.insert(places, matrices.point(one.place, at))
            table.insert(ones, one)
        end
    end
    return places, ones
end

-- Length and line of the way between the points over the surface.
local function surface(self, p, ones)
    if not rawequal(ones[1].mesh, ones[2].mesh) then return "two objects" end
    local straight = vectors.length(vectors.plus(p[1], p[2], -1))
    if self.points[1].face == self.points[2].face then
        return string.format("%.4g over the surface", straight), { p[1], p[2] }
    end
    local copy = in_world(ones[1])
    local distances = copy:distances{ from = { point = p[1] }, method = "front" }
    local length = mean(self.points[2], function(v) return distances[v] end)
    if not (length < math.huge) then return "two parts" end
    local from, to, line = copy:nearest(p[1]).vertex, copy:nearest(p[2]).vertex, { p[1], p[2] }
    if from ~= to then line = copy:path{ points = { from, to } }:points() end
    line[1], line[#line] = p[1], p[2]
    return string.format("%.4g over the surface", math.max(length, straight)), line
end

local measures = {
    distance = function(_, p)
        return string.format("%.4g", vectors.length(vectors.plus(p[1], p[2], -1))), { p[1], p[2] }
    end,
    angle = function(_, p)
        local a, b = vectors.plus(p[1], p[2], -1), vectors.plus(p[3], p[2], -1)
        if vectors.length(a) * vectors.length(b) == 0 then return "no angle", p end
        a, b = vectors.unit(a), vectors.unit(b)
        local half = math.atan(vectors.length(vectors.plus(a, b, -1)) / vectors.length(vectors.plus(a, b, 1)))
        return string.format("%.4g degrees", math.deg(2 * half)), p
    end,
    surface = surface,
    object = function(_, _, ones)
        local mesh = in_world(ones[1])
        return string.format("%s: area %.4g, volume %.4g%s", ones[1].name, mesh:area(), mesh:volume(),
            mesh:is_closed() and "" or " (open)")
    end,
}

-- The label and line of the measure, made anew if a point or the object has moved.
local function result(self, scene)
    local p, ones = located(self, scene)
    if #p < wanted[self.params.what] then return nil, p end
    local key = self.params.what .. ones[1].mesh:hash()
    for _, rows in ipairs{ p, ones[1].place } do
        for _, row in ipairs(rows) do key = key .. " " .. table.concat(row, " ") end
    end
    if key ~= self.measured then
        self.measured, self.text, self.line = key, measures[self.params.what](self, p, ones)
    end
    return self.text, p
end

return lissom.tool{
    name = "measure",
    help = "Click points. Keys: backspace takes the last back, d all.",
    params = {
        what = { type = "choice", default = "distance",
            choices = { "distance", "surface", "angle", "object" } },
    },
    points = {},
    press = function(self, ev)
        local hit = ev:pick{ kinds = { "vertex", "face" }, radius = 5 }
        if not hit then return end
        if #located(self, ev.scene) ~= #self.points or #self.points >= wanted[self.params.what] then
            self.points = {}
        end
        table.insert(self.points,
            { mesh = hit.mesh, face = hit.face, triangle = hit.triangle, bary = hit.bary })
    end,
    key = function(self, ev)
        if ev.key == "backspace" then table.remove(self.points) end
        if ev.key == "d" then self.points = {} end
    end,
    changed = function(self) self.points = {} end,
    draw = function(self, view)
        local text, points = result(self, view.scene)
        for _, point in ipairs(points) do view:handle{ at = point, color = color } end
        if not text then return end
        if self.line then view:line{ points = self.line, color = color, width = 3 } end
        view:label{ at = points[#points], text = text }
    end,
    deactivate = function(self) self.points, self.measured = {}, nil end,
}
