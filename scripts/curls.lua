--- Curls of strands that another program made: how wide and long they are and how they wind, and the course
-- that they wind around.
--
-- A course is the strand smoothed by about a Gaussian; a curl is seen by the turns of the way from the course
-- to the strand, which the smoothing makes shorter and leaves in its direction.
local curls = {}

-- With two arguments in every Lua.
local atan2 = rawget(math, "atan2") or math.atan

-- Metres: steps along strands, and the first smoothing, in which bends over a head leave half a millimetre.
local STEP, FIRST = 0.002, 0.012
-- Strands that are looked at, and the part of them that must curl.
local LOOKED, CURLY = 300, 0.4
-- Neighbours that are compared.
local PAIRS = 80
-- Neighbours that differ by less of a turn are of one lock.
local ALIKE = 0.35
-- The least radius in metres, and number of turns, of a curl; turns that go one way by so large a part are
-- those of a helix, others of a wave.
local LEAST_RADIUS, LEAST_TURNS, HELIX = 0.0008, 1.5, 0.6

local function minus(a, b) return { a[1] - b[1], a[2] - b[2], a[3] - b[3] } end
local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end
local function cross(a, b)
    return { a[2] * b[3] - a[3] * b[2], a[3] * b[1] - a[1] * b[3], a[1] * b[2] - a[2] * b[1] }
end
local function size(a) return math.sqrt(dot(a, a)) end

local function median(numbers)
    table.sort(numbers)
    return numbers[math.floor(#numbers / 2) + 1]
end

-- Each pass of half its strength spreads by the root of half the square of a step.
local function smoothed(even, sigma)
    local passes = math.max(1, math.floor(2 * (sigma / STEP) ^ 2 + 0.5))
    return even:copy():smooth{ iterations = math.min(passes, 4000) }
end

-- The points of each strand.
local function lists(strands)
    local all, made, first = strands:points(), {}, 1
    for s, count in ipairs(strands:point_counts()) do
        local points = {}
        for i = first, first + count - 1 do
            points[#points + 1] = { all[3 * i - 2], all[3 * i - 1], all[3 * i] }
        end
        made[s], first = points, first + count
    end
    return made
end

local function length_of(points)
    local sum = 0
    for k = 2, #points do sum = sum + size(minus(points[k], points[k - 1])) end
    return sum
end

-- The ways from a course to its strand, across it, without those near the ends, which smoothing holds.
local function ways_out(points, course, sigma)
    local ways, rim = {}, math.ceil(sigma / STEP)
    for k = 2 + rim, #points - 1 - rim do
        local along = minus(course[k + 1], course[k - 1])
        local length = size(along)
        if length > 0 then
            for c = 1, 3 do along[c] = along[c] / length end
            local way = minus(points[k], course[k])
            local part = dot(way, along)
            for c = 1, 3 do way[c] = way[c] - part * along[c] end
            ways[#ways + 1] = { way = way, along = along, k = k }
        end
    end
    return ways
end

-- Turns of a strand about its course, all and to the right less those to the left, and its radius.
local function turns_of(points, course, sigma)
    local ways = ways_out(points, course, sigma)
    local all, right, squares = 0, 0, 0
    for i, here in ipairs(ways) do
        squares = squares + dot(here.way, here.way) / #ways
        local before = ways[i - 1]
        if before then
            local turn = atan2(dot(here.along, cross(before.way, here.way)), dot(before.way, here.way))
            all, right = all + math.abs(turn) / (2 * math.pi), right + turn / (2 * math.pi)
        end
    end
    -- The part of the strand that was looked at.
    local part = #ways > 1 and (#ways - 1) / (#points - 1) or 1
    local helix = math.abs(right) > HELIX * all
    return { all = all / part, right = right / part, radius = math.sqrt((helix and 1 or 2) * squares),
        helix = helix, ways = ways }
end

-- Where curls begin and how soon they have their radius: the means of the radius along the strands.
local function beginning(found, radius)
    local sums, counts = {}, {}
    for _, strand in ipairs(found) do
        for _, way in ipairs(strand.ways) do
            local bin = math.floor(way.k * STEP * strand.shorter / 0.01) + 1
            sums[bin], counts[bin] = (sums[bin] or 0) + size(way.way), (counts[bin] or 0) + 1
        end
    end
    local quarter, most
    for bin = 1, 60 do
        local mean = sums[bin] and sums[bin] / counts[bin]
        if mean and not quarter and mean > 0.25 * radius then quarter = 0.01 * (bin - 1) end
        if mean and mean > 0.75 * radius then
            most = 0.01 * (bin - 1)
            break
        end
    end
    quarter, most = quarter or 0, most or 0.02
    local ramp = math.max(0.01, 2 * (most - quarter))
    return math.max(0, quarter - 0.25 * ramp), ramp
end

-- The strand whose root is nearest to each of some.
local function neighbours(strands)
    local roots, found = {}, {}
    for s = 1, #strands do roots[s] = strands:root(s).position end
    for s = 1, #strands, math.max(1, math.floor(#strands / PAIRS)) do
        local nearest, least = nil, math.huge
        for other = 1, #strands do
            local apart = other ~= s and size(minus(roots[other], roots[s])) or math.huge
            if apart < least then nearest, least = other, apart end
        end
        found[#found + 1], found[#found + 2] = s, nearest
    end
    return found
end

-- The mean cosine between the ways out of two strands.
local function likeness(a, b)
    local sum, count = 0, 0
    for k = 1, math.min(#a, #b) do
        local sizes = size(a[k].way) * size(b[k].way)
        if sizes > 0 then sum, count = sum + dot(a[k].way, b[k].way) / sizes, count + 1 end
    end
    return count > 0 and sum / count or 0
end

-- How neighbours curl: the part of a turn by which they differ (the mean cosine of turns that differ at
-- random by up to it), and how far apart their courses are halfway, in metres.
local function locks_of(strands, sigma)
    local even = strands:select{ strands = neighbours(strands) }:resample{ step = STEP }
    local points, courses, cosines, gaps = lists(even), lists(smoothed(even, sigma)), {}, {}
    for i = 1, #points - 1, 2 do
        local p, q = courses[i], courses[i + 1]
        local middle = math.floor(math.min(#p, #q) / 2) + 1
        cosines[#cosines + 1] = likeness(ways_out(points[i], p, sigma), ways_out(points[i + 1], q, sigma))
        gaps[#gaps + 1] = size(minus(p[middle], q[middle]))
    end
    local phase = math.sqrt(12 * math.max(0, 1 - median(cosines))) / (2 * math.pi)
    return math.max(0.03, math.min(1, phase)), median(gaps)
end

--- Measures the curls of strands. Returns nothing if most do not curl; else the options of hair:curl
-- (`radius`, `wavelength`, `start`, `ramp`, `hand`, `depth`, `variation`, `phase`), the `spread` of locks,
-- half the distance between neighbours in metres, `turn`, the length of hair in a turn, and `share`, the
-- part of the strands that curl.
function curls.measure(strands)
    local some, step = {}, math.max(1, math.floor(#strands / LOOKED))
    for s = 1, #strands, step do some[#some + 1] = s end
    local even = strands:select{ strands = some }:resample{ step = STEP }
    local points, courses = lists(even), lists(smoothed(even, FIRST))
    local turns = {}
    for s = 1, #points do
        local seen = turns_of(points[s], courses[s], FIRST)
        if seen.all >= LEAST_TURNS and seen.radius > 0.3 * LEAST_RADIUS then
            turns[#turns + 1] = length_of(points[s]) / seen.all
        end
    end
    if #turns < CURLY * #points then return nil end
    -- Again around a course without what winds so long.
    local turn = median(turns)
    local sigma = 0.5 * turn
    courses = lists(smoothed(even, sigma))
    local found, radii, waves, right, all = {}, {}, {}, 0, 0
    for s = 1, #points do
        local seen = turns_of(points[s], courses[s], sigma)
        if seen.all >= LEAST_TURNS and seen.radius > LEAST_RADIUS then
            local length = length_of(courses[s])
            seen.shorter = length / math.max(length_of(points[s]), 1e-9)
            found[#found + 1], radii[#radii + 1] = seen, seen.radius
            waves[#waves + 1] = length / seen.all
            right, all = right + seen.right, all + seen.all
        end
    end
    if #found < CURLY * #points then return nil end
    local radius, helices, spread = median(radii), 0, {}
    for i, seen in ipairs(found) do
        helices = helices + (seen.helix and 1 or 0)
        spread[i] = math.abs(seen.radius - radius) / radius
    end
    local start, ramp = beginning(found, radius)
    local phase, apart = locks_of(strands, sigma)
    return { radius = radius, wavelength = median(waves), start = start, ramp = ramp,
        hand = math.abs(right) < HELIX * all and "random" or right > 0 and "right" or "left",
        depth = helices > 0.5 * #found and 1 or 0.2, variation = math.min(0.5, median(spread)),
        phase = phase, spread = 0.5 * apart, turn = turn, share = #found / #points }
end

--- The courses of strands that curl as measured: as many strands, with the same roots.
function curls.courses(strands, curl)
    return smoothed(strands:copy():resample{ step = STEP }, 0.5 * curl.turn)
end

--- Winds hair as measured, by so many locks, and gathers it to them before if neighbours curl alike:
-- operators on top of a style, with their own options.
function curls.wind(hair, curl, locks)
    hair:guides{ count = math.min(locks, #hair) }
    if curl.phase < ALIKE then
        hair:gather{ factor = 0.9, spread = curl.spread, ramp = curl.start + curl.ramp + 0.02 }
    end
    return hair:curl{ radius = curl.radius, wavelength = curl.wavelength, start = curl.start,
        ramp = curl.ramp, phase = curl.phase, hand = curl.hand, depth = curl.depth,
        variation = curl.variation, hang = 0, keep_length = false }
end

return curls
