-- Writes the same models plainly and in every compressed form, for a reader that is not ours:
--     lissom run tests/gltf/written.lua --out FOLDER
-- NAME_plain.glb is the model; NAME_FORM.glb the same, and NAME_FORM_BITS.glb the same to so many bits.
-- NAME.json has its numbers of vertices and faces, and its bounds.
local lissom = require "lissom"

local params = lissom.params{ out = { type = "folder", default = "out", help = "folder of the files" } }

local function with_uv(mesh)
    local values, positions = {}, mesh:positions()
    for i = 1, #positions, 3 do
        values[#values + 1] = 0.5 + 0.1 * positions[i]
        values[#values + 1] = 0.5 + 0.1 * positions[i + 1]
    end
    mesh:add_attribute{ name = "uv", domain = "vertex", width = 2, values = values }
    return mesh
end

local function bent_bar()
    local bar = with_uv(lissom.shapes.bar{ across = 4, along = 24 })
    local deformer = lissom.deformer(bar)
    deformer:add_handle(bar:region("bottom"))
    local top = deformer:add_handle(bar:region("top"))
    return deformer, function(time) top:set{ rotate = { axis = "z", angle = 70 * math.sin(6 * time) } } end
end

-- A ball whose faces have three materials in turns, by way of a file that can name them.
local function materials()
    local ball = with_uv(lissom.shapes.sphere{ segments = 16 })
    local path, lines = params.out .. "/materials.obj", {}
    ball:save(path)
    local face = 0
    for line in io.lines(path) do
        if line:sub(1, 2) == "f " then
            lines[#lines + 1] = "usemtl " .. ({ "red", "blue", "green" })[math.floor(face / 7) % 3 + 1]
            face = face + 1
        end
        lines[#lines + 1] = line
    end
    local file = assert(io.open(path, "w"))
    file:write(table.concat(lines, "\n"), "\n")
    file:close()
    return lissom.load(path)
end

local deformer, pose = bent_bar()
local models = {
    sphere = with_uv(lissom.shapes.sphere{ segments = 24 }),
    baked = deformer:bake{ pose = pose, duration = 1, fps = 12 },
    summed = deformer:bake{ pose = pose, duration = 1, fps = 12, tolerance = 0.002 },
    skinned = deformer:skin{ joints = 5, pose = pose, duration = 1, fps = 12 },
    materials = materials(),
}

local forms = { { "meshopt", "meshopt" }, { "meshopt_12", "meshopt", 12 }, { "draco", "draco" },
    { "draco_12", "draco", 12 }, { "integers_12", "none", 12 } }

for name, mesh in pairs(models) do
    mesh:save(params.out .. "/" .. name .. "_plain.glb")
    for _, form in ipairs(forms) do
        local path = ("%s/%s_%s.glb"):format(params.out, name, form[1])
        local saved, problem = pcall(mesh.save, mesh, path, { compression = form[2], quantize = form[3] })
        -- A build may lack a codec.
        if not saved then print("not written: " .. path .. ": " .. tostring(problem)) end
    end
    local box = mesh:bounds()
    local file = assert(io.open(params.out .. "/" .. name .. ".json", "w"))
    file:write(('{"vertices":%d,"faces":%d,"min":[%.9g,%.9g,%.9g],"max":[%.9g,%.9g,%.9g]}'):format(#mesh,
        mesh:face_count(), box.min[1], box.min[2], box.min[3], box.max[1], box.max[2], box.max[3]))
    file:close()
end
