-- What pages wait for, in seconds of a processor, each the least of some rounds: a deformation of 43 000
-- vertices is prepared and goes on by a frame, 20 000 strands grow and grow again, two shapes are merged.
local lissom = require "lissom"

local function least(rounds, work)
    local best = math.huge
    for _ = 1, rounds do
        local start = os.clock()
        work()
        best = math.min(best, os.clock() - start)
    end
    return best
end

local function bent_cactus()
    local cactus = lissom.shapes.cactus{ vertices = 43000 }
    local deformer = lissom.deformer(cactus)
    deformer:pin(cactus:region("base"))
    return deformer, deformer:add_handle(cactus:region("tip"))
end

local function deformation()
    local deformer, tip
    local function turn()
        tip:rotate{ axis = "z", angle = 3, about = { 0, 0, 0 } }
        deformer:solve()
    end
    local first = least(3, function()
        deformer, tip = bent_cactus()
        turn()
    end)
    local shape = least(3, function() lissom.shapes.cactus{ vertices = 43000 } end)
    local frame = least(10, turn)
    return first - shape - frame, frame
end

local function hair()
    local style = lissom.hairstyle(lissom.shapes.head{ vertices = 8000 }, { resolution = 20000 })
    local function places(shift)
        return { style:at{ azimuth = 30 + shift, elevation = 60, lift = 0.02 },
            style:at{ azimuth = 80 + shift, elevation = 30, lift = 0.02 },
            style:at{ azimuth = 95 + shift, elevation = -30, lift = 0.02 } }
    end
    local stream = style:add_stream(places(0))
    local function grow() style:grow{ count = 20000, length = 0.2 } end
    local first = least(1, grow)
    local shift = 0
    local again = least(5, function()
        shift = shift + 2
        stream:set_points(places(shift))
        grow()
    end)
    return first, again
end

local function merging()
    local head = lissom.shapes.head{ vertices = 8000 }
    head = head:cut{ plane = { point = { 0, -0.15, 0 }, normal = { 0, 1, 0 }, seed = { 0, 0.1, 0 } } }
    local cactus = lissom.shapes.cactus{ vertices = 8000, ribs = 0 }
    cactus = cactus:cut{ plane = { point = { 0, 1.7, 0 }, normal = { 0, -1, 0 } } }
    return least(3, function() lissom.merge(head, cactus) end)
end

local rows = {}
rows.prepare, rows.frame = deformation()
rows.hair_first, rows.hair_again = hair()
rows.merge = merging()
for _, name in ipairs{ "prepare", "frame", "hair_first", "hair_again", "merge" } do
    print(name, rows[name])
end
