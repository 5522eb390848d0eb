--- Hair of others, as a scan, a simulation or another program made it, becomes a style that can be edited:
-- its unit and place are found, guides are chosen, and streams along these make a field whose hair has the
-- lengths of the given one. `refit.style` does all; the other functions are its steps.
local curls = require "curls"
local lissom = require "lissom"

local refit = {}

-- Metres, centimetres, millimetres, decimetres, inches and tenths of them, in metres.
local UNITS = { 1, 0.01, 0.001, 0.1, 0.0254, 0.00254 }
-- Roots that lie so near to the head, in metres, are where they belong.
local ON_HEAD = 0.012
-- So many strands fill the hair: others have no place far from all of them.
local ENOUGH = 3000
-- Strays are away with more than this part of their length.
local STRAYS = 0.3
-- Roots of hair of a head are spread by so much about their mean, in metres.
local LEAST_SPREAD, GREATEST_SPREAD = 0.03, 0.13

local function distance(a, b)
    return math.sqrt((a[1] - b[1]) ^ 2 + (a[2] - b[2]) ^ 2 + (a[3] - b[3]) ^ 2)
end

local function scaled(p, factor) return { factor * p[1], factor * p[2], factor * p[3] } end

local function mean(points)
    local sum = { 0, 0, 0 }
    for _, p in ipairs(points) do
        for k = 1, 3 do sum[k] = sum[k] + p[k] / #points end
    end
    return sum
end

-- Root mean square of the distances from their mean.
local function spread(points)
    local middle, sum = mean(points), 0
    for _, p in ipairs(points) do sum = sum + distance(p, middle) ^ 2 / #points end
    return math.sqrt(sum)
end

local function median(numbers)
    table.sort(numbers)
    return numbers[math.floor((#numbers + 1) / 2)]
end

-- Every n-th root, at most `most`.
local function some_roots(strands, most)
    local roots, step = {}, math.max(1, math.floor(#strands / most))
    for s = 1, #strands, step do roots[#roots + 1] = strands:root(s).position end
    return roots
end

-- The median distance of points in metres from a head with so long a unit.
local function height(points, head, unit)
    local heights = {}
    for i, p in ipairs(points) do heights[i] = unit * head:nearest(scaled(p, 1 / unit)).distance end
    return median(heights)
end

local function moved(p, motion)
    local x, z = p[1], p[3]
    local a = math.rad(motion.turn)
    local c, s = math.cos(a), math.sin(a)
    local turned = { c * x + s * z, p[2], c * z - s * x }
    if motion.up == "z" then turned = { c * x - s * p[2], z, -s * x - c * p[2] } end
    local q = scaled(turned, motion.scale)
    for k = 1, 3 do q[k] = q[k] + motion.move[k] end
    return q
end

local function all_moved(points, motion)
    local result = {}
    for i, p in ipairs(points) do result[i] = moved(p, motion) end
    return result
end

-- Scale and translation that bring points nearest to their targets, by least squares.
local function fitted(motion, points, targets)
    local at, to = mean(points), mean(targets)
    local along, square = 0, 0
    for i, p in ipairs(points) do
        for k = 1, 3 do
            along = along + (p[k] - at[k]) * (targets[i][k] - to[k])
            square = square + (p[k] - at[k]) ^ 2
        end
    end
    local factor = square > 0 and math.max(along / square, 0.2) or 1
    local move = {}
    for k = 1, 3 do move[k] = to[k] + factor * (motion.move[k] - at[k]) end
    return { up = motion.up, turn = motion.turn, scale = factor * motion.scale, move = move }
end

-- Roots are laid on the hairy region, and then brought to their nearest points of it, again and again.
local function onto_head(roots, scalp, up, turn)
    local head, unit, hairy = scalp:head(), scalp:unit(), {}
    for _, v in ipairs(scalp:region():vertices()) do
        local x, y, z = head:position(v)
        hairy[#hairy + 1] = { unit * x, unit * y, unit * z }
    end
    local skin = head:extract(scalp:region())
    local motion = { up = up, turn = turn, scale = 1, move = { 0, 0, 0 } }
    motion.scale = spread(hairy) / math.max(spread(roots), 1e-12)
    local from, to = mean(all_moved(roots, motion)), mean(hairy)
    for k = 1, 3 do motion.move[k] = to[k] - from[k] end
    for _ = 1, 20 do
        local points, targets = all_moved(roots, motion), {}
        for i, p in ipairs(points) do
            targets[i] = scaled(skin:nearest(scaled(p, 1 / unit)).position, unit)
        end
        motion = fitted(motion, points, targets)
    end
    return motion, height(all_moved(roots, motion), head, unit)
end

--- The motion that brings strands onto a head: { up =, turn =, scale =, move = }, applied as the strands'
-- axis is turned up, then about it in degrees, scaled and moved in metres; and the median distance of their
-- roots from the head then. Hair that lies on the head in one of the usual units only gets that unit; other
-- hair is laid on the scalp in the best of eight turns, scaled as its roots are spread.
function refit.place(strands, scalp)
    local roots = some_roots(strands, 300)
    local head, unit = scalp:head(), scalp:unit()
    for _, factor in ipairs(UNITS) do
        local points = {}
        for i, p in ipairs(roots) do points[i] = scaled(p, factor) end
        local wide = spread(points)
        local off = height(points, head, unit)
        local few = #strands < 20 and wide < GREATEST_SPREAD
        if off < ON_HEAD and (few or (wide > LEAST_SPREAD and wide < GREATEST_SPREAD)) then
            return { up = "y", turn = 0, scale = factor, move = { 0, 0, 0 } }, off
        end
    end
    local best, least
    for _, up in ipairs{ "y", "z" } do
        for turn = 0, 270, 90 do
            local motion, off = onto_head(roots, scalp, up, turn)
            if not least or off < least then best, least = motion, off end
        end
    end
    return best, least
end

--- Moves strands as `refit.place` says.
function refit.move(strands, motion)
    if motion.up == "z" then strands:transform{ rotate = { axis = "x", angle = -90 } } end
    strands:transform{ rotate = { axis = "y", angle = motion.turn }, scale = motion.scale }
    return strands:transform{ translate = motion.move }
end

-- A grid of cells with the numbers of points in metres, to find those near a place.
local Cells = {}
Cells.__index = Cells

local function cell_key(p, size, dx, dy, dz)
    return (math.floor(p[1] / size) + dx) + 4099 * ((math.floor(p[2] / size) + dy)
        + 4099 * (math.floor(p[3] / size) + dz))
end

function Cells.of(points, size)
    local self = setmetatable({ points = points, size = size, lists = {} }, Cells)
    for i, p in ipairs(points) do
        local key = cell_key(p, size, 0, 0, 0)
        self.lists[key] = self.lists[key] or {}
        table.insert(self.lists[key], i)
    end
    return self
end

-- Calls f(number, distance) for the points nearer than the size of a cell.
-- It stops if f returns true.
function Cells:near(p, f)
    for k = 0, 26 do
        local n = (k + 13) % 27  -- its own cell first
        local key = cell_key(p, self.size, n % 3 - 1, math.floor(n / 3) % 3 - 1, math.floor(n / 9) - 1)
        for _, i in ipairs(self.lists[key] or {}) do
            local d = distance(p, self.points[i])
            if d < self.size and f(i, d) then return true end
        end
    end
    return false
end

local function roots_and_lengths(strands)
    local roots, lengths, points, first = {}, {}, strands:points(), 1
    for s, count in ipairs(strands:point_counts()) do
        local sum, last = 0, nil
        for i = first, first + count - 1 do
            local p = { points[3 * i - 2], points[3 * i - 1], points[3 * i] }
            if last then sum = sum + distance(p, last) else roots[s] = p end
            last = p
        end
        lengths[s] = sum
        first = first + count
    end
    return roots, lengths
end

-- The hairy part of a head: vertices very near to roots, and those within reach of one on a usual scalp.
local function region_of(scalp, cells)
    local head, unit, usual, vertices = scalp:head(), scalp:unit(), scalp:region(), {}
    local positions = head:positions()
    for v = 1, #head do
        local nearest = math.huge
        local p = { positions[3 * v - 2], positions[3 * v - 1], positions[3 * v] }
        cells:near(scaled(p, unit), function(_, d) nearest = math.min(nearest, d) end)
        if nearest < 0.008 or (nearest < cells.size and usual:contains(v)) then
            vertices[#vertices + 1] = v
        end
    end
    return head:region{ vertices = vertices }
end

-- A function of vertices for style:grow: the mean of values at roots, weighted by nearness.
local function blended(unit, cells, values, outside)
    return function(_, x, y, z)
        local sum, weights = 0, 0
        cells:near({ unit * x, unit * y, unit * z }, function(i, d)
            local w = 1 / (d * d + 1e-6)
            sum, weights = sum + w * values[i], weights + w
        end)
        return weights > 0 and sum / weights or outside
    end
end

-- A number for each vertex, for style:grow: how many roots are near, as a part of the most.
local function crowded(head, unit, cells)
    local positions, counts, most = head:positions(), {}, 1
    for v = 1, #head do
        local count = 0
        local p = scaled({ positions[3 * v - 2], positions[3 * v - 1], positions[3 * v] }, unit)
        cells:near(p, function(_, d) count = count + (1 - d / cells.size) end)
        counts[v], most = count, math.max(most, count)
    end
    for v = 1, #head do counts[v] = counts[v] / most end
    return counts
end

-- A box in metres of the scalp's frame around strands, with room for a few grid steps.
local function volume_around(strands, scalp)
    local unit, points = scalp:unit(), strands:points()
    local low, high = { 1e9, 1e9, 1e9 }, { -1e9, -1e9, -1e9 }
    local function extend(p, room)
        for k = 1, 3 do
            low[k], high[k] = math.min(low[k], p[k] - room), math.max(high[k], p[k] + room)
        end
    end
    for i = 1, #points / 3, math.max(1, math.floor(#points / 3e5)) do
        local p = { points[3 * i - 2], points[3 * i - 1], points[3 * i] }
        extend(scalp:to_metres(scaled(p, 1 / unit)), 0.02)
    end
    local head = scalp:head()
    for _, v in ipairs(scalp:region():vertices()) do extend(scalp:to_metres(head:position(v)), 0.03) end
    return { min = low, max = high }
end

-- A stream along each guide.
local function add_streams(style, guides, unit)
    for g = 1, #guides do
        local buffer, points = guides:strand(g), {}
        for i = 1, #buffer / 3 do
            points[i] = { buffer[3 * i - 2] / unit, buffer[3 * i - 1] / unit, buffer[3 * i] / unit }
        end
        if #points > 1 and distance(points[1], points[#points]) > 1e-6 / unit then
            style:add_stream{ points = points, name = "guide " .. g, clearance = 0, stop = false }
        end
    end
end

--- The angle between strands and a style's field, in degrees, in the mean over the length of `most` strands.
function refit.angle_error(strands, style, most)
    local unit, sum, all = style:scalp():unit(), 0, 0
    for s = 1, #strands, math.max(1, math.floor(#strands / (most or 400))) do
        local points = strands:strand(s)
        for i = 2, #points / 3 do
            local a = { points[3 * i - 5], points[3 * i - 4], points[3 * i - 3] }
            local b = { points[3 * i - 2], points[3 * i - 1], points[3 * i] }
            local size = distance(a, b)
            local f = style:field(scaled({ a[1] + b[1], a[2] + b[2], a[3] + b[3] }, 0.5 / unit))
            local length = distance(f, { 0, 0, 0 })
            if size > 0 and length > 0 then
                local along = 0
                for k = 1, 3 do along = along + f[k] * (b[k] - a[k]) / size / length end
                sum = sum + size * math.deg(math.acos(math.max(-1, math.min(1, along))))
                all = all + size
            end
        end
    end
    return all > 0 and sum / all or 0
end

--- The difference of the lengths of two sets of strands at the same roots, as a part of the mean length.
function refit.length_error(strands, others)
    local roots, lengths = roots_and_lengths(strands)
    local other_roots, other_lengths = roots_and_lengths(others)
    local local_length = blended(1, Cells.of(roots, 0.02), lengths)
    local sum, all = 0, 0
    for s, p in ipairs(other_roots) do
        local length = local_length(s, p[1], p[2], p[3])
        if length then sum, all = sum + math.abs(other_lengths[s] - length), all + length end
    end
    return all > 0 and sum / all or 1
end

-- Removes strands shorter than `least`.
local function without_short(strands, least)
    local _, lengths = roots_and_lengths(strands)
    local mask, any = {}, false
    for s, length in ipairs(lengths) do
        mask[s] = length < least and 1 or 0
        any = any or length < least
    end
    if any then strands:cull{ mask = mask } end
end

--- Removes strands that mostly run farther than `reach` metres from all of the others, as they do from a
-- parting, where the field is a mean of both sides. Returns the number of removed strands.
function refit.remove_strays(hair, others, reach)
    local places, points = {}, others:copy():resample{ step = 0.7 * reach }:points()
    for i = 1, #points / 3 do places[i] = { points[3 * i - 2], points[3 * i - 1], points[3 * i] } end
    local cells, mask, count, grown, first = Cells.of(places, reach), {}, 0, hair:points(), 1
    for s, size in ipairs(hair:point_counts()) do
        local away, all = 0, 0
        for i = first, first + size - 1, 3 do
            local p = { grown[3 * i - 2], grown[3 * i - 1], grown[3 * i] }
            all = all + 1
            if not cells:near(p, function() return true end) then away = away + 1 end
        end
        mask[s] = away > STRAYS * all and 1 or 0
        count, first = count + mask[s], first + size
    end
    if count > 0 then hair:cull{ mask = mask } end
    return count
end

--- Makes a style of strands, which it moves onto a head. Options: `scalp` (else guessed), `guides` (150),
-- `count` of the hair that grows (as many as are given), `seed` (1), `resolution` (50,000), `place` (true:
-- finds unit and place; false: the strands lie on the head, in metres), `min_length` in metres, below which
-- strands are removed (0.002), `stray` in metres (0.01): if there are 3,000 strands or more, grown hair
-- that mostly runs farther than this from all of them is left out. Returns a table: `style`; `grow`, the
-- options of style:grow; `hair`, grown with them; `guides`; `motion`, as refit.place returns it; `height`,
-- the median distance in metres of the roots from the head before they were put onto it; `angle`, the mean
-- error of directions in degrees; `length`, the mean error of lengths, as a part of them; `curl`, the curls
-- as curls.measure finds them, or nothing: `hair` has them as an operator on top, and the style flows as the
-- courses that they wind around. The option `curls` = false leaves curls in the courses.
function refit.style(strands, head, options)
    options = options or {}
    local scalp = options.scalp or lissom.scalp(head)
    local unit = scalp:unit()
    local motion, height_before = { up = "y", turn = 0, scale = 1, move = { 0, 0, 0 } }, nil
    if options.place ~= false then
        motion, height_before = refit.place(strands, scalp)
        refit.move(strands, motion)
    end
    without_short(strands, options.min_length or 0.002)
    if #strands < 3 then error("a style needs at least three strands longer than min_length", 2) end
    -- Curls are an operator on top: the style flows as the courses that they wind around.
    local curl = options.curls ~= false and curls.measure(strands) or nil
    local given = strands
    if curl then strands = curls.courses(strands, curl) end
    local roots, lengths = roots_and_lengths(strands)
    -- Few roots are so far from each other as on a scalp of 500 square centimetres.
    local reach = math.max(0.008, 1.5 * math.sqrt(0.05 / #roots))
    local cells = Cells.of(roots, 1.5 * reach)
    local region = region_of(scalp, Cells.of(roots, reach))
    local hairy = lissom.scalp(head, { region = region, unit = unit })
    local style = lissom.hairstyle(head, { scalp = hairy, gravity = 0,
        resolution = options.resolution or 50000, volume = volume_around(strands, hairy) })
    strands:attach{ head = style }
    local guides = strands:guide_set{ count = math.min(options.guides or 150, #strands), points = 20 }
    add_streams(style, guides:guides(), unit)
    local per_metre, middle = 1 / (unit * hairy:scale()), 0
    for i, length in ipairs(lengths) do
        lengths[i] = per_metre * length
        middle = middle + lengths[i] / #lengths
    end
    local grow = { count = options.count or #strands, seed = options.seed or 1, variation = 0,
        length = blended(unit, cells, lengths, middle), density = crowded(head, unit, cells),
        layer = 0, clearance = 0.001 }
    local hair = style:grow(grow)
    if #roots >= ENOUGH then refit.remove_strays(hair, strands, options.stray or 0.01) end
    local angle = refit.angle_error(strands, style)
    if curl then curls.wind(hair, curl, #guides:guides()) end
    return { style = style, grow = grow, hair = hair, curl = curl, guides = guides, motion = motion,
        height = height_before, angle = angle, length = refit.length_error(given, hair) }
end

return refit
