local lissom = require "lissom"
local expect = require "expect"

local name = os.tmpname()
local function path(extension) return name .. extension end

-- Upright strands on a grid, with a little bend.
local function lawn(count, points)
    local all, counts = {}, {}
    for s = 1, count do
        for k = 0, points - 1 do
            all[#all + 1] = { 0.004 * (s % 20) + 0.0005 * k * k, 0.01 * k, 0.004 * math.floor(s / 20) }
        end
        counts[s] = points
    end
    return lissom.strands{ points = all, counts = counts }
end

local hair = lawn(200, 12)
expect.equal(#hair, 200)
expect.equal(tostring(hair), "lissom.Strands: 200 strands, 2400 points")
expect.equal(hair:strand(3):count(), 12)
expect.near_list({ hair:strand(3):get(1) }, { 0.012, 0, 0 }, 1e-7)
expect.equal(hair:points():count(), 2400)
expect.equal(hair:stats().most_points, 12)
expect.equal(hair:stats().not_finite, 0)

-- Operators change the strands in place and return them; roots stay.
local before = hair:copy()
expect.truthy(rawequal(hair:clump{ clumps = 20 }:noise{}:smooth{}:taper{}, hair))
expect.truthy(hair:hash() ~= before:hash())
for s = 1, #hair do
    expect.near_list({ hair:strand(s):get(1) }, { before:strand(s):get(1) }, 0)
end
hair:trim{ length = 0.05, plane = { point = { 0, 0.04, 0 }, normal = { 0, 1, 0 } } }
expect.truthy(hair:stats().most_length < 0.0501)
expect.truthy(hair:bounds().max[2] < 0.0401)
expect.equal(hair:resample{ count = 5 }:points():count(), 1000)

-- A prefix stays the prefix.
local options = { clumps = 20, strength = 0.8 }
expect.equal(before:select{ first = 50 }:clump(options):hash(),
    before:copy():clump(options):select{ first = 50 }:hash())

-- Choosing.
expect.equal(#before:select{ strands = { 5, 2 } }, 2)
expect.equal(#before:select{ where = function(_, x) return x < 0.003 end }, 10)
expect.failure("out_of_range", before:select{ group = "fringe" })
expect.error("'where'", function() before:select{ where = function() error("'where' fails") end } end)
expect.equal(#before:copy():append(before), 400)

-- Files.
for _, extension in ipairs{ ".hair", ".data", ".usda" } do
    local saved, report = before:save(path(extension))
    expect.truthy(rawequal(saved, before))
    expect.equal(#report, 0)
    local back = assert(lissom.load_strands(path(extension)))
    expect.near_list(back:points():table(), before:points():table(), 0)
    os.remove(path(extension))
end
for _, extension in ipairs{ ".rib", ".glb", ".gltf", ".obj" } do
    assert(before:save(path(extension)))
    os.remove(path(extension))
end
local odd = lissom.strands{ points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } }, counts = { 1, 2 } }
local _, report = odd:save(path(".hair"), { up = "z", unit = 0.01 })
expect.equal(report[1].kind, "strands_too_short")
expect.near_list(report[1].strands, { 1 })
local turned = lissom.load_strands(path(".hair"), { up = "z", unit = 0.01 })
expect.near_list({ turned:strand(1):get(2) }, { 1, 1, 0 }, 1e-6)
os.remove(path(".hair"))

-- Widths and colours go into the files that have them; what is not given stays.
local dyed = before:copy()
expect.truthy(rawequal(dyed:set_widths{ width = 9e-5, profile = { 1, 0.5 } }, dyed))
dyed:set_colors{ color = { 0.3, 0.2, 0.1 } }
assert(dyed:save(path(".hair")))
expect.truthy(lissom.load_strands(path(".hair")):hash() ~= before:hash())
os.remove(path(".hair"))
expect.equal(dyed:copy():set_widths{ width = 9e-5 }:hash(), dyed:hash())
expect.truthy(dyed:copy():set_widths{ profile = {} }:hash() ~= dyed:hash())
local each = {}
for s = 1, #dyed do each[s] = { s / #dyed, 0, 0 } end
expect.truthy(dyed:copy():set_colors{ colors = each }:hash() ~= dyed:hash())
expect.error("200 strands", function() dyed:set_colors{ colors = { { 1, 0, 0 } } } end)
expect.error("negative", function() dyed:set_colors{ color = { 1, -1, 0 } } end)
expect.error("negative", function() dyed:set_widths{ profile = { 1, -1 } } end)
expect.error("'profile'", function() dyed:set_widths{} end)
expect.error("either", function() dyed:set_widths{ width = 1, widths = { 1 } } end)

-- The world's faults and misuse.
expect.failure("file_not_found", lissom.load_strands(path(".hair")))
expect.failure("unknown_format", before:save(path(".abc")))
expect.error("201", function() before:strand(201) end)
expect.error("strenght", function() before:clump{ strenght = 1 } end)
os.remove(name)
