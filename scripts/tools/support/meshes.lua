--- Queries of the tools to a scene: its meshes, their places, the selection on them.
local lissom = require "lissom"
local matrices = require "matrices"
local vectors = require "vectors"

local meshes = {}

--- An object of the scene, or a region of a mesh; nil if there is none of that name.
function meshes.object(scene, name) return (lissom.try(scene.get, scene, name)) end
function meshes.region(mesh, name) return (lissom.try(mesh.region, mesh, name)) end

--- The scene's information about an object; nil if there is none of that name.
function meshes.info(scene, name) return (lissom.try(scene.info, scene, name)) end

--- The mesh that an object of the scene is, or deforms; nil if there is none.
function meshes.get(scene, name)
    local object = meshes.object(scene, name)
    if not object then return nil end
    local kind = scene:info(name).kind
    if kind == "deformation" then return object:mesh() end
    return kind == "mesh" and object or nil
end

--- The visible meshes: a list of { name =, mesh =, place =, style = }. The place is the matrix from the
-- mesh's own space to the world. A deformation without its mesh in the scene counts as its mesh.
function meshes.visible(scene)
    local list, edits, seen = {}, {}, {}
    local function add(name, info, mesh)
        if seen[mesh] then return end
        seen[mesh] = true
        table.insert(list, { name = name, mesh = mesh, place = info.transform, style = info.style })
    end
    for _, name in ipairs(scene:names()) do
        local info = scene:info(name)
        if info.visible and info.kind == "mesh" then add(name, info, scene:get(name)) end
        if info.visible and info.kind == "deformation" then edits[#edits + 1] = { name, info } end
    end
    for _, edit in ipairs(edits) do add(edit[1], edit[2], scene:get(edit[1]):mesh()) end
    return list
end

--- The one of them that is a certain mesh, such as that of a hit; nil if it is no longer visible.
function meshes.find(scene, mesh)
    for _, one in ipairs(meshes.visible(scene)) do
        if rawequal(one.mesh, mesh) then return one end
    end
    return nil
end

--- The selected vertices of a mesh, maybe none: its region "selected", which all tools share.
function meshes.selection(mesh) return meshes.region(mesh, "selected") or mesh:region{ vertices = {} } end

--- Selects vertices of a mesh, instead of those before.
function meshes.select(mesh, region)
    if #region > 0 then
        mesh:set_region("selected", region)
    else
        mesh:remove_region("selected")
    end
end

--- The connected parts of its mesh that a region lies on.
function meshes.parts(region)
    local mesh = region:mesh()
    local all, parts = mesh:region{ all = true }, mesh:region{ vertices = {} }
    for _, vertex in ipairs(region:vertices()) do
        if not parts:contains(vertex) then parts = parts:union(all:connected{ at = vertex }) end
    end
    return parts
end

--- A region without specks that a brush catches behind the surface: connected parts of less than a hundredth
-- of it.
function meshes.without_specks(region)
    local rest, kept = region, region
    while #rest > 0 do
        local part = rest:connected{ at = rest:vertices()[1] }
        if #part < 0.01 * #region then kept = kept:minus(part) end
        rest = rest:minus(part)
    end
    return kept
end

--- A region with its pinholes closed, such as a brush leaves: connected parts of up to ten vertices within
-- it, and at most a quarter of it.
function meshes.without_pinholes(region)
    local rest, closed = region:invert(), region
    while #rest > 0 do
        local part = rest:connected{ at = rest:vertices()[1] }
        local is_small = #part <= math.min(10, #region / 4)
        if is_small and #part:grow(1) > #part then closed = closed:union(part) end
        rest = rest:minus(part)
    end
    return closed
end

--- The subject if nothing is pointed at: the first visible mesh with a selection, else the only one; nil if
-- there are several.
function meshes.subject(scene)
    local list = meshes.visible(scene)
    for _, one in ipairs(list) do
        if #meshes.selection(one.mesh) > 0 then return one end
    end
    return #list == 1 and list[1] or nil
end

--- Name and object of the deformation of a mesh that is in the scene; nil if there is none, or it was made
-- before faces of the mesh changed.
function meshes.deformation(scene, mesh)
    for _, name in ipairs(scene:names()) do
        local deformer = scene:get(name)
        if scene:info(name).kind == "deformation" and rawequal(deformer:mesh(), mesh)
            and pcall(deformer.handles, deformer) then return name, deformer end
    end
    return nil
end

--- Ends the deformation of a mesh, which keeps its shape: the next one begins from that. The mesh itself
-- takes its place if it is not in the scene yet.
function meshes.end_deformation(scene, mesh)
    local name = meshes.deformation(scene, mesh)
    if not name then return end
    local info = scene:info(name)
    if meshes.region(mesh, "pinned") then mesh:remove_region("pinned") end
    scene:remove(name)
    for _, other in ipairs(scene:names()) do
        if rawequal(scene:get(other), mesh) then return end
    end
    scene:add(name, mesh, { transform = info.transform, visible = info.visible, style = info.style })
end

--- The middle of a mesh in the world, and the radius of a ball around it that has the mesh inside.
function meshes.ball(one)
    local box = one.mesh:bounds()
    if not box then return matrices.point(one.place, { 0, 0, 0 }), 0 end         -- a mesh without vertices
    local center, radius = matrices.point(one.place, box.center), 0
    for i = 0, 7 do
        local corner = {}
        for axis = 1, 3 do
            corner[axis] = math.floor(i / 2 ^ (axis - 1)) % 2 == 0 and box.min[axis] or box.max[axis]
        end
        radius = math.max(radius, vectors.length(vectors.plus(matrices.point(one.place, corner), center, -1)))
    end
    return center, radius
end

--- A name that no object of a scene has: that given, or the same with a number.
function meshes.unused_name(scene, name)
    local base, number = name:gsub(" %d+$", ""), 2
    while meshes.object(scene, name) do
        name, number = base .. " " .. number, number + 1
    end
    return name
end

return meshes
