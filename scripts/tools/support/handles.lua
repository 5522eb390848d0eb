--- The handles of the deformations in a scene.
local lissom = require "lissom"
local matrices = require "matrices"
local meshes = require "tools.support.meshes"

local handles = {}

--- All handles on visible meshes: { handle =, deformer =, name =, mesh =, place =, at =, pinned = } for each:
-- name of the deformation in the scene, the matrix from the mesh's own space to the world, the handle's
-- middle there, whether it only holds its place.
function handles.list(scene)
    local list = {}
    for _, one in ipairs(meshes.visible(scene)) do
        local name, deformer = meshes.deformation(scene, one.mesh)
        local pinned = meshes.region(one.mesh, "pinned")
        for _, handle in ipairs(deformer and deformer:handles() or {}) do
            local at = matrices.point(one.place, handle:center())
            table.insert(list,
                { handle = handle, deformer = deformer, name = name, mesh = one.mesh, place = one.place,
                    at = at, pinned = pinned and #handle:region():minus(pinned) == 0 })
        end
    end
    return list
end

--- Pins a handle: its vertices are in the mesh's region "pinned", which is saved with it.
function handles.pin(handle)
    for _, pin in ipairs{ handle, handle:mirrored() } do
        local region = pin:region()
        local before = meshes.region(region:mesh(), "pinned")
        region:mesh():set_region("pinned", before and before:union(region) or region)
    end
end

-- A handle, and its mirror image, are pinned no longer.
local function unpin(handle)
    for _, pin in ipairs{ handle, handle:mirrored() } do
        local region = pin:region()
        local mesh, before = region:mesh(), meshes.region(region:mesh(), "pinned")
        local rest = before and before:minus(region)
        if rest and #rest > 0 then mesh:set_region("pinned", rest) end
        if rest and #rest == 0 then mesh:remove_region("pinned") end
    end
end

--- Place in a list of the `chosen` handle, else of the last one that is not pinned; 0 for none.
function handles.number(list, chosen)
    local number = 0
    for i, one in ipairs(list) do
        if one.handle == chosen then return i end
        if not one.pinned then number = i end
    end
    return number
end

--- The deformation of a mesh that is in the scene, else a new one: of the part within a distance around a
-- region; of the parts of the mesh that it lies on, for a distance of 0.
function handles.deformation(scene, one, region, reach)
    local _, deformer = meshes.deformation(scene, one.mesh)
    if deformer then return deformer end
    local movable = meshes.parts(region)
    if reach > 0 then movable = one.mesh:region{ geodesic = { from = region, radius = reach } } end
    local name = meshes.unused_name(scene, one.name .. " deformation")
    return scene:add(name, lissom.deformer(one.mesh, { region = movable }), { visible = false })
end

--- Moves a handle by a motion of the world, from its former matrix.
function handles.follow(one, before, motion)
    local back = matrices.inverse(one.place)
    one.handle:set_matrix(before)
    if motion.kind == "rotate" then         -- which says, other than a matrix, how often it goes round
        local sign = matrices.mirrors(one.place) and -1 or 1
        one.handle:rotate{ axis = matrices.direction(back, motion.axis), angle = sign * motion.angle }
    end
    one.handle:set_matrix(matrices.product(back, motion.matrix, one.place, before))
end

-- Vertices that follow a drag at full quality.
local max_exact = 60000

--- Preview of a deformation during a drag: "always", "never", or for "large meshes".
function handles.preview(one, of)
    local quick = of == "always" or of == "large meshes" and #one.deformer:region() > max_exact
    if quick then return one.deformer:preview() end
    return one.deformer:solve{ draft = true }
end

--- Takes a handle away. Without any the mesh keeps its shape, and the next one begins from there.
function handles.remove(scene, one)
    unpin(one.handle)
    if #one.deformer:handles() == (one.handle:mirrored() and 2 or 1) then
        meshes.end_deformation(scene, one.mesh)
    else
        one.handle:remove()
        one.deformer:solve()
    end
end

return handles
