--- Chains of bones in a scene: their joints in the world, the part under the cursor, new ones along a
-- stroke.
local handles = require "tools.support.handles"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"
local vectors = require "vectors"

local joint_radius = 12         -- pixels
local bone_radius = 8

local bone_chains = {}

local function between(a, b) return vectors.plus(b, a, -1) end

--- All chains on visible meshes: { bones =, deformer =, mesh =, place =, joints = } for each, the joints in
-- the world.
function bone_chains.list(scene)
    local list = {}
    for _, one in ipairs(meshes.visible(scene)) do
        local _, deformer = meshes.deformation(scene, one.mesh)
        for _, bones in ipairs(deformer and deformer:bones() or {}) do
            local joints = {}
            for i, joint in ipairs(bones:joints()) do joints[i] = matrices.point(one.place, joint) end
            table.insert(list, { bones = bones, deformer = deformer, mesh = one.mesh, place = one.place,
                joints = joints })
        end
    end
    return list
end

--- The point in the middle of the body under the cursor, in the space of its mesh; nil beside it.
function bone_chains.middle(ev, one)
    local back = matrices.inverse(one.place)
    local origin, way = ev:ray()
    origin, way = matrices.point(back, origin), matrices.direction(back, way)
    local entry = one.mesh:pick(origin, way)
    if not entry then return nil end
    local beyond = 1e-4 * one.mesh:size() / vectors.length(way)
    local exit = one.mesh:pick(vectors.plus(entry.position, way, beyond), way)
    local far = exit and exit.position or entry.position
    return vectors.plus(entry.position, between(entry.position, far), 0.5)
end

-- A line without the jitter of a hand and the steps of what it passes over; its ends stay.
local function smoothed(line)
    for _ = 1, 3 do
        local next = { line[1] }
        for i = 2, #line - 1 do
            local bend = between(vectors.plus(line[i], line[i], 1), vectors.plus(line[i - 1], line[i + 1], 1))
            next[i] = vectors.plus(line[i], bend, 0.25)
        end
        next[#line] = line[#line]
        line = next
    end
    return line
end

--- Points at equal distances along a drawn line.
function bone_chains.spaced(drawn, count)
    local line, lengths = smoothed(drawn), { 0 }
    for i = 2, #line do lengths[i] = lengths[i - 1] + vectors.length(between(line[i - 1], line[i])) end
    local points, i = { line[1] }, 2
    for k = 1, count - 2 do
        local at = lengths[#line] * k / (count - 1)
        while lengths[i] < at do i = i + 1 end
        local share = (at - lengths[i - 1]) / (lengths[i] - lengths[i - 1])
        points[k + 1] = vectors.plus(line[i - 1], between(line[i - 1], line[i]), share)
    end
    points[count] = line[#line]
    return points
end

local function at_rest(deformer)
    for _, handle in ipairs(deformer:handles()) do
        local matrix = handle:matrix()
        for r = 1, 3 do
            for c = 1, 4 do
                if matrix[r][c] ~= (r == c and 1 or 0) then return false end
            end
        end
    end
    return true
end

-- The body: the vertices farther from what the bones hold than `room` lengths of the first one, and nearer to
-- the base than to the tip, over the surface.
local function body_of(mesh, deformer, bones, room)
    local joints, held = bones:joints(), bones:handle(1):region()
    for i = 2, #bones do held = held:union(bones:handle(i):region()) end
    local to_bones = mesh:distances{ from = held }
    local to_base = mesh:distances{ from = { point = joints[1] } }
    local to_tip = mesh:distances{ from = { point = joints[#joints] } }
    local reach = room * vectors.length(between(joints[1], joints[2]))
    local body = {}
    for _, v in ipairs(deformer:region():vertices()) do
        if to_bones[v] > reach and to_base[v] <= to_tip[v] then table.insert(body, v) end
    end
    return mesh:region{ vertices = body }
end

-- Takes away the pins of a mesh; returns their vertices.
local function unpin(scene, mesh)
    local pinned = mesh:region{ vertices = {} }
    for _, one in ipairs(handles.list(scene)) do
        if one.pinned and rawequal(one.mesh, mesh) then
            pinned = pinned:union(one.handle:region())
            one.handle:remove()
        end
    end
    if #pinned > 0 then mesh:remove_region("pinned") end
    return pinned
end

--- Lays a chain through joints in the space of a mesh, which begins from its present shape. The first one
-- pins the body, and each frees its limb. `params` are limit (degrees, 180 for none) and room.
function bone_chains.lay(scene, one, joints, params)
    local near = one.mesh:nearest(joints[1]).vertex
    local deformer = handles.deformation(scene, one, one.mesh:region{ vertices = { near } }, 0)
    local is_first = #deformer:handles() == 0
    if not at_rest(deformer) then deformer:rebase() end
    local limits
    if params.limit < 180 then
        limits = {}
        for i = 1, #joints - 1 do limits[i] = params.limit end
    end
    local pinned = unpin(scene, one.mesh)
    local bones = deformer:add_bones{ joints = joints, limits = limits }
    local body = body_of(one.mesh, deformer, bones, params.room)
    if not is_first then body = body:intersect(pinned) end
    if #body > 0 and (params.room > 0 or not is_first) then handles.pin(deformer:add_handle(body)) end
    return bones
end

--- Distance of two pixels.
function bone_chains.pixels(a, b) return math.sqrt((a[1] - b[1]) ^ 2 + (a[2] - b[2]) ^ 2) end

-- Distance of a pixel from the line between two others.
local function pixels_from_line(p, a, b)
    local way = { b[1] - a[1], b[2] - a[2] }
    local square = way[1] ^ 2 + way[2] ^ 2
    local t = square > 0 and ((p[1] - a[1]) * way[1] + (p[2] - a[2]) * way[2]) / square or 0
    t = math.min(math.max(t, 0), 1)
    return bone_chains.pixels(p, { a[1] + t * way[1], a[2] + t * way[2] })
end

--- The part of a chain under the cursor: { chain =, part = "move", "reach" or "turn", bone = }; nil for none.
-- Ends go before other joints, and joints before bones.
function bone_chains.part_under(ev, list)
    local cursor, best, least = { ev.x, ev.y }, nil, math.huge
    local function offer(order, pixels, radius, part)
        if pixels > radius or order * 1e3 + pixels >= least then return end
        best, least = part, order * 1e3 + pixels
    end
    for _, chain in ipairs(list) do
        local seen, count = {}, #chain.joints
        for i, joint in ipairs(chain.joints) do
            local x, y = ev.camera:project(joint, ev.size)
            seen[i] = x == x and { x, y } or nil                        -- not behind the camera
        end
        for i = 1, count do
            local is_end = i == 1 or i == count
            local part = i == 1 and "move" or i == count and "reach" or "turn"
            if seen[i] then
                offer(is_end and 0 or 1, bone_chains.pixels(cursor, seen[i]), joint_radius,
                    { chain = chain, part = part, bone = i - 1 })
            end
            if seen[i] and seen[i + 1] then
                offer(2, pixels_from_line(cursor, seen[i], seen[i + 1]), bone_radius,
                    { chain = chain, part = "turn", bone = i })
            end
        end
    end
    return best
end

--- Angle of the cursor about a joint in the picture, anticlockwise, in degrees; the axis towards the eye.
function bone_chains.angle_about(ev, joint)
    local x, y = ev.camera:project(joint, ev.size)
    local _, way = ev.camera:ray(x, y, ev.size)
    return math.deg(math.atan(y - ev.y, ev.x - x)), vectors.plus({ 0, 0, 0 }, way, -1)
end

--- The point of the world under the cursor that is as deep in the picture as another.
function bone_chains.beside(ev, point)
    local _, _, depth = ev.camera:project(point, ev.size)
    return ev.camera:unproject(ev.x, ev.y, depth, ev.size)
end

return bone_chains
