--- Vectors {x, y, z}.
local vectors = {}

--- a + s b.
function vectors.plus(a, b, s) return { a[1] + s * b[1], a[2] + s * b[2], a[3] + s * b[3] } end

function vectors.dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end

function vectors.cross(a, b)
    return { a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1] }
end

function vectors.length(a) return math.sqrt(vectors.dot(a, a)) end

function vectors.unit(a) return vectors.plus({ 0, 0, 0 }, a, 1 / vectors.length(a)) end

return vectors
