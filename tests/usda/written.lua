-- Writes hair as .usda for a reader that is not ours: free, and bound to the joints of its head.
--     lissom run tests/usda/written.lua --out FOLDER
local lissom = require "lissom"

local params = lissom.params{ out = { type = "folder", default = "out", help = "folder of the files" } }

-- The head with joints that turn its neck.
local function skinned(head)
    local deformer = lissom.deformer(head)
    local box = head:bounds()
    local function at(share) return box.min[2] + share * (box.max[2] - box.min[2]) end
    deformer:add_handle(head:region{ where = function(_, _, y) return y < at(0.15) end })
    deformer:add_handle(head:region{ where = function(_, _, y) return y > at(0.7) end })
    return deformer:skin{ joints = 4, angle = 30, preview = true }
end

local head = lissom.shapes.head{ vertices = 3000 }
local style = lissom.hairstyle(head, { resolution = 5000 })
style:add_stream{ points = { style:at{ azimuth = 20, elevation = 50, lift = 0.01 },
    style:at{ azimuth = 70, elevation = 10, lift = 0.02 } } }
local hair = style:grow{ count = 120, seed = 3, length = 0.1 }
local bound = skinned(head)
hair:save(params.out .. "/free.usda")
hair:save(params.out .. "/bound.usda", { head = bound })
hair:save(params.out .. "/bound_z.usda", { head = bound, up = "z", unit = 0.01 })
