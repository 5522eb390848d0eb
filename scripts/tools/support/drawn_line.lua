--- A line of a mesh that a hand has drawn along, and its new course by a second stroke.
local matrices = require "matrices"
local meshes = require "tools.support.meshes"

local drawn_line = {}

local aside = 12                -- pixels within which an outline is looked for
local stays = 20                -- and within which an end stays

local function look(ev, x, y, mesh)
    local hit = ev.camera:pick{ scene = ev.scene, x = x, y = y, size = ev.size }
    return hit and (not mesh or rawequal(hit.mesh, mesh)) and hit or nil
end

-- The surface just inside the outline between a pixel on the mesh and one beside it.
local function at_outline(ev, mesh, inside, outside)
    for _ = 1, 7 do
        local x, y = (inside[1] + outside[1]) / 2, (inside[2] + outside[2]) / 2
        if look(ev, x, y, mesh) then inside = { x, y } else outside = { x, y } end
    end
    return look(ev, inside[1], inside[2], mesh), inside
end

-- For each pixel of a stroke: the hit there, and that at the outline if this is near.
local function hits_along(ev, mesh, pixels)
    local plain, outline = {}, {}
    for i, p in ipairs(pixels) do
        local a, b = pixels[math.max(i - 1, 1)], pixels[math.min(i + 1, #pixels)]
        local u, v = b[1] - a[1], b[2] - a[2]
        local size = math.max(math.sqrt(u * u + v * v), 1e-9)
        local left = { p[1] - aside * v / size, p[2] + aside * u / size }
        local right = { p[1] + aside * v / size, p[2] - aside * u / size }
        local on_left, on_right = look(ev, left[1], left[2], mesh), look(ev, right[1], right[2], mesh)
        local here = look(ev, p[1], p[2], mesh)
        if here then table.insert(plain, { hit = here, pixel = p }) end
        if (on_left == nil) ~= (on_right == nil) then
            local hit, pixel = at_outline(ev, mesh, on_left and left or right, on_left and right or left)
            table.insert(outline, { hit = hit, pixel = pixel })
        end
    end
    return #outline > 0.6 * #pixels and outline or plain
end

-- One point a face: { hit =, pixel = }.
local function apart(list)
    local seen, kept = {}, {}
    for _, one in ipairs(list) do
        if not seen[one.hit.face] then
            seen[one.hit.face] = true
            table.insert(kept, one)
        end
    end
    return kept
end

--- The mesh that pixels lie on or near, the first one; nil if there is none.
function drawn_line.mesh(ev, pixels)
    for _, p in ipairs(pixels) do
        for _, way in ipairs{ { 0, 0 }, { aside, 0 }, { -aside, 0 }, { 0, aside }, { 0, -aside } } do
            local hit = look(ev, p[1] + way[1], p[2] + way[2])
            local one = hit and meshes.find(ev.scene, hit.mesh)
            if one then return one.mesh end
        end
    end
    return nil
end

--- The points of a mesh along a stroke, at its outline if the stroke follows that: a list of { hit =, pixel =
-- }, no two on one face.
function drawn_line.on(ev, mesh, pixels) return apart(hits_along(ev, mesh, pixels)) end

local function distance(a, b) return math.sqrt((a[1] - b[1]) ^ 2 + (a[2] - b[2]) ^ 2) end

-- Hits of a pixel's ray on a mesh, in the mesh's own space: first and last; nil if it misses.
local function through(ev, one, pixel)
    local first, last
    local under = { scene = ev.scene, x = pixel[1], y = pixel[2], size = ev.size, through = true }
    for _, hit in ipairs(ev.camera:pick_all(under)) do
        if rawequal(hit.mesh, one.mesh) then first, last = first or hit, hit end
    end
    if not first then return nil end
    local back = matrices.inverse(one.place)
    return matrices.point(back, first.position), matrices.point(back, last.position)
end

--- The closed line that a stroke draws on the mesh under it, and the mesh as meshes.find has it. A stroke
-- back to its start runs round on the visible side; one from beside the mesh across it to beside it also
-- comes back behind. A stroke that is neither is an error with a remedy.
function drawn_line.loop(ev, pixels)
    local mesh = drawn_line.mesh(ev, pixels)
    local one = mesh and meshes.find(ev.scene, mesh)
    if not one then error("draw over a mesh", 0) end
    local line, behind, first, last = {}, {}, pixels[1], pixels[#pixels]
    for _, pixel in ipairs(pixels) do
        local front, rear = through(ev, one, pixel)
        if front then
            table.insert(line, front)
            table.insert(behind, 1, rear)
        end
    end
    if #line == #pixels and distance(first, last) < stays then return line, one end
    if look(ev, first[1], first[2], mesh) or look(ev, last[1], last[2], mesh) then
        error("draw back to the start of the line, or from beside the mesh across it to beside it", 0)
    end
    table.move(behind, 1, #behind, #line + 1, line)
    return line, one
end

--- The destination pixels of the points of such a line: at the same fractions of a new stroke, in either
-- direction. Ends near their old place stay.
function drawn_line.targets(line, pixels)
    local first, last = line[1].pixel, line[#line].pixel
    local course = { table.unpack(pixels) }
    if distance(first, course[1]) > distance(first, course[#course]) then
        for i = 1, #course do course[i] = pixels[#course + 1 - i] end
    end
    if distance(first, course[1]) < stays then course[1] = first end
    if distance(last, course[#course]) < stays then course[#course] = last end
    local new, old, list = { 0 }, { 0 }, {}
    for i = 2, #course do new[i] = new[i - 1] + distance(course[i], course[i - 1]) end
    for i = 2, #line do old[i] = old[i - 1] + distance(line[i].pixel, line[i - 1].pixel) end
    local k = 2
    for i = 1, #line do
        local place = old[i] / old[#old] * new[#new]
        while k < #course and new[k] < place do k = k + 1 end
        local t = math.max(0, math.min(1, (place - new[k - 1]) / math.max(new[k] - new[k - 1], 1e-9)))
        local a, b = course[k - 1], course[k]
        list[i] = { a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2]) }
    end
    return list
end

return drawn_line
