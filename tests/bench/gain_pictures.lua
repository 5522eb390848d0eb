-- One picture for each paste that `bench_gain --pictures=FOLDER` has saved: pasted along the outline that was
-- marked, along the thesis's loop, and along ours, from left to right.
--
--     ./dev build bench bench_gain && build/bench/tests/bench/bench_gain --pictures=out/gain
--     ./dev lissom run tests/bench/gain_pictures.lua --folder out/gain
--
-- Writes FOLDER/CASE.png from two sides.
local lissom = require "lissom"

local params = lissom.params{
    folder = { type = "string", default = "out/gain", help = "where the meshes are" },
    only = { type = "string", default = "", help = "only cases whose name contains this" },
    wire = { type = "boolean", default = false, help = "draw the edges" },
}

local cases = {
    "bunny_s_ear_on_Planck_s_crown", "armadillo_s_arm_on_the_bunny_s_rump", "half_of_eight_on_Planck_s_crown",
    "elephant_s_ear_on_Planck_s_side", "Planck_s_nose_on_the_bunny", "dinosaur_s_neck_on_the_bunny",
    "a_hand_on_Planck_s_crown", "Spot_s_head_on_the_armadillo_s_back",
}
local ways = { "outline_as_marked", "thesis_s_loop", "ours" }

for _, case in ipairs(cases) do
    local meshes, names = {}, {}
    for _, way in ipairs(case:find(params.only, 1, true) and ways or {}) do
        local mesh = lissom.load(params.folder .. "/" .. case .. "__" .. way .. ".ply")
        if mesh then meshes[#meshes + 1], names[#names + 1] = mesh, way end
    end
    for _, view in ipairs(#meshes > 0 and { "front", "right" } or {}) do
        local file = params.folder .. "/" .. case .. "_" .. view .. ".png"
        assert(lissom.render{ meshes = meshes, columns = #meshes, wire = params.wire, view = view,
            size = { 480 * #meshes, 560 }, file = file })
        print(file .. ": " .. table.concat(names, ", "))
    end
end
