--- Smooth models from unit cubes: a few cells set the form, subdivision rounds it. Faces may be left
-- out, if the model is to be open.
--
--     local blocks = require "blocks"
--     local cells = blocks.cells{ { 0, 0, 0, 3, 1, 1 }, { 1, 2, 0 } }     -- a beam, a cell on it
--     local mesh = blocks.surface{ cells = cells, open = { { 1, 2, 0, "y" } }, levels = 3 }
local lissom = require "lissom"

local blocks = {}

local function name(x, y, z) return x .. " " .. y .. " " .. z end

--- All cells of a list of boxes, each { x, y, z } for one cell or { x0, y0, z0, x1, y1, z1 } with both
-- corners in. Boxes may overlap.
function blocks.cells(boxes)
    local cells, known = {}, {}
    for _, box in ipairs(boxes) do
        for x = box[1], box[4] or box[1] do
            for y = box[2], box[5] or box[2] do
                for z = box[3], box[6] or box[3] do
                    if not known[name(x, y, z)] then table.insert(cells, { x, y, z }) end
                    known[name(x, y, z)] = true
                end
            end
        end
    end
    return cells
end

-- For each direction the step to the neighbour and the corners of the face there, counter-clockwise seen from
-- outside.
local sides = {
    { "x", { 1, 0, 0 }, { { 1, 0, 0 }, { 1, 1, 0 }, { 1, 1, 1 }, { 1, 0, 1 } } },
    { "-x", { -1, 0, 0 }, { { 0, 0, 0 }, { 0, 0, 1 }, { 0, 1, 1 }, { 0, 1, 0 } } },
    { "y", { 0, 1, 0 }, { { 0, 1, 0 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 1, 0 } } },
    { "-y", { 0, -1, 0 }, { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 1 }, { 0, 0, 1 } } },
    { "z", { 0, 0, 1 }, { { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } } },
    { "-z", { 0, 0, -1 }, { { 0, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 1, 0, 0 } } },
}

local function set_of(list, key)
    local set = {}
    for _, item in ipairs(list) do set[key(item)] = true end
    return set
end

--- The surface of a set of cells. Options: cells, a list of { x, y, z } of whole numbers; open, a list of
-- { x, y, z, "-y" }, faces that are left out; levels of Catmull-Clark subdivision (default 3); soft, steps of
-- smoothing in between (default 3). Cells that touch along an edge only are an error.
function blocks.surface(options)
    local filled = set_of(options.cells, function(c) return name(c[1], c[2], c[3]) end)
    local open = set_of(options.open or {}, function(f) return name(f[1], f[2], f[3]) .. " " .. f[4] end)
    local positions, faces, ids = {}, {}, {}
    local function corner(cell, offset)
        local p = { cell[1] + offset[1], cell[2] + offset[2], cell[3] + offset[3] }
        local key = name(p[1], p[2], p[3])
        if not ids[key] then
            table.insert(positions, p)
            ids[key] = #positions
        end
        return ids[key]
    end
    for _, cell in ipairs(options.cells) do
        for _, side in ipairs(sides) do
            local step = side[2]
            local inside = filled[name(cell[1] + step[1], cell[2] + step[2], cell[3] + step[3])]
            if not inside and not open[name(cell[1], cell[2], cell[3]) .. " " .. side[1]] then
                local face = {}
                for k = 1, 4 do face[k] = corner(cell, side[3][k]) end
                table.insert(faces, face)
            end
        end
    end
    local mesh, problem = lissom.try(lissom.mesh,
        { positions = positions, faces = faces, repair = false, weld = false })
    if not mesh then
        lissom.error{ message = "these cells have no surface: " .. problem, code = problem.code, level = 2 }
    end
    local levels = options.levels or 3
    mesh = mesh:subdivide(1, { scheme = "catmull_clark" })
    mesh:smooth{ iterations = options.soft or 3, keep_volume = true }
    return mesh:subdivide(levels - 1, { scheme = "catmull_clark" })
end

-- ---- Models

--- A body on four legs along z, its neck towards +z and +y. Options: open, whether the neck is (default
-- true); legs, their length in cells (default 3); levels.
function blocks.beast(options)
    options = options or {}
    local legs = options.legs or 3
    local cells = blocks.cells{
        { 0, 0, 0, 2, 1, 5 }, { 0, 2, 3, 2, 2, 5 }, { 1, 3, 4, 1, 3, 5 }, { 1, 4, 5 },
        { 0, -legs, 0, 0, -1, 0 }, { 2, -legs, 0, 2, -1, 0 },
        { 0, -legs, 5, 0, -1, 5 }, { 2, -legs, 5, 2, -1, 5 },
        { 0, -legs, 6 }, { 2, -legs, 6 }, { 0, -legs, 1 }, { 2, -legs, 1 },
        { 1, 1, -1 }, { 1, 0, -2, 1, 1, -2 }, { 1, -1, -2 },
    }
    local open = options.open ~= false and { { 1, 4, 5, "y" } } or nil
    return blocks.surface{ cells = cells, open = open, levels = options.levels or 3 }
        :transform{ translate = { -1.5, legs, -3 } }
end

--- A torso that faces +z. Options: neck, "open" (the default) or "closed"; waist, "closed" (the default) or
-- "open"; levels.
function blocks.torso(options)
    options = options or {}
    local cells = blocks.cells{
        { 0, 0, 0, 2, 1, 1 }, { 0, 2, 0, 2, 4, 1 }, { -1, 4, 0, 3, 4, 1 }, { -1, 3, 0, -1, 3, 1 },
        { 3, 3, 0, 3, 3, 1 }, { 1, 5, 0, 1, 5, 0 },
    }
    local open = options.neck ~= "closed" and { { 1, 5, 0, "y" } } or {}
    if options.waist == "open" then
        for x = 0, 2 do
            for z = 0, 1 do table.insert(open, { x, 0, z, "-y" }) end
        end
    end
    return blocks.surface{ cells = cells, open = open, levels = options.levels or 3 }
        :transform{ translate = { -1.5, 0, -0.5 }, scale = { 0.9, 1, 0.8 }, about = { 1.5, 0, 1 } }
end

--- A tail that lies along z with its flukes at the low end, open towards +z.
function blocks.tail(options)
    options = options or {}
    local cells = blocks.cells{
        { 0, 0, 3, 2, 1, 5 }, { 1, 0, -3, 1, 1, 2 }, { 0, 0, -4, 2, 0, -4 }, { -1, 0, -5, 0, 0, -5 },
        { 2, 0, -5, 3, 0, -5 },
    }
    local open = {}
    for x = 0, 2 do
        for y = 0, 1 do table.insert(open, { x, y, 5, "z" }) end
    end
    return blocks.surface{ cells = cells, open = open, levels = options.levels or 3 }
        :transform{ translate = { -1.5, -1, 0 } }
end

--- A frame with a hole in its middle and four open arms of one size, like a valve: genus 1, four boundaries.
function blocks.valve(options)
    options = options or {}
    local cells, open = {}, {}
    for x = -1, 1 do
        for z = -1, 1 do
            if x ~= 0 or z ~= 0 then table.insert(cells, { x, 0, z }) end
        end
    end
    for _, arm in ipairs{ { 1, 0, "x" }, { 0, 1, "z" }, { -1, 0, "-x" }, { 0, -1, "-z" } } do
        for k = 2, 3 do table.insert(cells, { k * arm[1], 0, k * arm[2] }) end
        table.insert(open, { 3 * arm[1], 0, 3 * arm[2], arm[3] })
    end
    return blocks.surface{ cells = cells, open = open, levels = options.levels or 4 }
        :transform{ translate = { -0.5, -0.5, -0.5 } }
end

--- A head with two long ears that stand upwards, closed, facing +z.
function blocks.hare(options)
    options = options or {}
    local cells = blocks.cells{
        { 0, 0, 0, 4, 2, 3 }, { 1, 0, 4, 3, 1, 4 }, { 0, 3, 1, 0, 7, 1 }, { 4, 3, 1, 4, 7, 1 },
    }
    return blocks.surface{ cells = cells, levels = options.levels or 3 }
        :transform{ translate = { -2.5, 0, -1.5 } }
end

return blocks
