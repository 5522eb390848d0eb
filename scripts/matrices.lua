--- Matrices that move points: four rows of four numbers, the last 0, 0, 0, 1, as scenes, handles and gizmos
--- have them.
local vectors = require "vectors"

local matrices = {}

--- The matrix that moves nothing.
function matrices.identity()
    return { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 }, { 0, 0, 0, 1 } }
end

--- The matrix that moves by a vector.
function matrices.translation(v)
    return { { 1, 0, 0, v[1] }, { 0, 1, 0, v[2] }, { 0, 0, 1, v[3] }, { 0, 0, 0, 1 } }
end

--- The matrix that turns by degrees about an axis through a point.
function matrices.rotation(axis, degrees, about)
    local n, angle = vectors.unit(axis), math.rad(degrees)
    local c, s = math.cos(angle), math.sin(angle)
    local m = matrices.identity()
    for i = 1, 3 do
        local e = { 0, 0, 0 }
        e[i] = 1
        local across = vectors.cross(n, e)
        for j = 1, 3 do m[j][i] = c * e[j] + s * across[j] + (1 - c) * n[i] * n[j] end
    end
    local moved = matrices.direction(m, about)
    for j = 1, 3 do m[j][4] = about[j] - moved[j] end
    return m
end

--- Does b first, then a; of more, the last first.
function matrices.product(a, b, ...)
    local m = {}
    for i = 1, 4 do
        m[i] = {}
        for j = 1, 4 do
            m[i][j] = a[i][1] * b[1][j] + a[i][2] * b[2][j] + a[i][3] * b[3][j] + a[i][4] * b[4][j]
        end
    end
    if ... then return matrices.product(m, ...) end
    return m
end

--- Returns the image of a point.
function matrices.point(m, p)
    local function row(i) return m[i][1] * p[1] + m[i][2] * p[2] + m[i][3] * p[3] + m[i][4] end
    return { row(1), row(2), row(3) }
end

--- Returns the image of a direction, without the translation of the matrix.
function matrices.direction(m, d)
    local function row(i) return m[i][1] * d[1] + m[i][2] * d[2] + m[i][3] * d[3] end
    return { row(1), row(2), row(3) }
end

--- Whether it takes left to right.
function matrices.mirrors(m) return vectors.dot(m[1], vectors.cross(m[2], m[3])) < 0 end

--- The matrix that moves back.
function matrices.inverse(m)
    local across = { vectors.cross(m[2], m[3]), vectors.cross(m[3], m[1]), vectors.cross(m[1], m[2]) }
    local size = vectors.dot(m[1], across[1])
    local back = {}
    for i = 1, 3 do back[i] = { across[1][i] / size, across[2][i] / size, across[3][i] / size } end
    local start = matrices.direction(back, { m[1][4], m[2][4], m[3][4] })
    for i = 1, 3 do back[i][4] = -start[i] end
    back[4] = { 0, 0, 0, 1 }
    return back
end

return matrices
