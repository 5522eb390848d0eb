-- One picture for each case that `bench_quality --pictures=FOLDER` has saved, its methods side by side.
--
--     ./dev bench quality --pictures=out/quality
--     ./dev lissom run tests/bench/quality/pictures.lua --folder out/quality
--
-- Writes FOLDER/CASE.png and prints which methods it shows, from left to right.

local lissom = require "lissom"

local params = lissom.params{
    folder = { type = "string", default = "out/quality", help = "where the meshes are" },
    only = { type = "string", default = "", help = "only cases whose name contains this" },
    wire = { type = "boolean", default = false, help = "draw the edges" },
}

local cases = {
    bar = { "twist_90", "twist_135", "twist_170", "twist_270", "twist_360", "bend_90", "bend_135", "bend_180",
        "bend_270", "sideways" },
    armadillo_arm = { "raise_60", "raise_100", "raise_150" },
    armadillo_body = { "twist_90", "bend_60" },
    armadillo_arm_alone = { "raise_60", "raise_100", "raise_150" },
    armadillo_waist = { "twist_90", "bend_60" },
}

local methods = {
    "first_system_only", "laplacian", "poisson", "blend_the_default", "blend_refine_2",
    "CGAL_ORIGINAL_ARAP_default", "CGAL_SPOKES_AND_RIMS_default", "CGAL_SPOKES_AND_RIMS_50",
    "CGAL_SRE_ARAP_default",
}

local function load_results(case)
    local meshes, names = {}, {}
    for _, method in ipairs(methods) do
        local mesh = lissom.load(params.folder .. "/" .. case .. "__" .. method .. ".ply")
        if mesh then
            meshes[#meshes + 1], names[#names + 1] = mesh, method
        end
    end
    return meshes, names
end

for scene, moves in pairs(cases) do
    for _, move in ipairs(moves) do
        local case = scene .. "_" .. move
        local meshes, names = {}, {}
        if case:find(params.only, 1, true) then meshes, names = load_results(case) end
        if #meshes > 0 then
            local columns = math.min(#meshes, 5)
            local rows = (#meshes + columns - 1) // columns
            assert(lissom.render{
                meshes = meshes, columns = columns, wire = params.wire,
                view = "front",
                size = { 400 * columns, 440 * rows }, file = params.folder .. "/" .. case .. ".png",
            })
            print(case .. ".png: " .. table.concat(names, ", "))
        end
    end
end
