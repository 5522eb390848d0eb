--- Looks of a merge: its report in words, and pictures of before, after and the seam.
--
--     local merge_pictures = require "merge_pictures"
--     merge_pictures.print("mermaid", mesh, report, parts)
--     merge_pictures.write{ name = "mermaid", out = "out", mesh = mesh, report = report, parts = parts }
local lissom = require "lissom"
local merging = require "merging"
local vectors = require "vectors"

local merge_pictures = {}

--- Prints the findings of a merge and how well the seam is hidden.
function merge_pictures.print(name, mesh, report, parts)
    print(string.format("%s: %d vertices, %d of them free, genus %d, prepared in %.3f s, "
        .. "solved in %.3f s", name, #mesh, report.free_vertices, mesh:genus(), report.prepare_seconds,
        report.solve_seconds))
    for i, join in ipairs(report.joins) do
        print(string.format("  join %d: %d vertices meet %d, scale %.3g%s%s%s", i, join.source_size,
            join.target_size, join.scale, join.placed ~= "keys" and ", placed " .. join.placed or "",
            join.source_trimmed and ", source trimmed" or "",
            join.target_trimmed and ", target trimmed" or ""))
    end
    local before, after = report.seam.before, report.seam.after
    print(string.format("  seam: greatest angle between faces %.1f degrees (%.1f before smoothing), "
        .. "rms %.1f, smallest angles %.1f", after.max_dihedral, before.max_dihedral,
        after.rms_dihedral, after.low_angle))
    print("  " .. tostring(report))
    for _, warning in ipairs(parts and parts.warnings or {}) do print("  " .. warning) end
    for _, warning in ipairs(report.warnings) do print("  " .. warning) end
end

--- Colours, as of the attribute "color", of the parts from targets and from sources.
merge_pictures.blue, merge_pictures.sand = { 0.42, 0.58, 0.80, 1 }, { 0.86, 0.70, 0.46, 1 }

--- A copy of a merged mesh in two colours: blue for the targets, sand for the source.
function merge_pictures.colored(mesh, report)
    local copy = mesh:copy()
    for _, name in ipairs{ "color", "normal" } do copy:remove_attribute(name) end
    local colors = copy:add_attribute{ name = "color", domain = "vertex", width = 4 }
    for v = 1, #mesh do
        local color = report.target:contains(v) and merge_pictures.blue or merge_pictures.sand
        for k = 1, 4 do colors[4 * v - 4 + k] = color[k] end
    end
    return copy
end

-- A copy without colours of its own, so that two meshes look alike.
local function plain(mesh)
    local copy = mesh:copy()
    copy:remove_attribute("color")
    return copy
end

-- The middle of a closed line, its mean radius, and the axis around which it runs.
local function ring_frame(path)
    local points, center, radius = path:points(), merging.center(path), 0
    for _, p in ipairs(points) do radius = radius + vectors.length(vectors.plus(p, center, -1)) / #points end
    return center, radius, merging.axis(path)
end

--- A camera that looks at a seam from the side. Options: seam, its number; from, the direction to stand in,
-- which is turned to be square to the seam's axis; up; wide, the height of the picture in radii of the
-- seam.
function merge_pictures.seam_camera(report, options)
    local center, radius, axis = ring_frame(report.seams[options.seam or 1])
    local from = vectors.unit(merging.direction(options.from or { 0.5, 0.25, 0.83 }))
    local side = vectors.plus(from, axis, -0.85 * vectors.dot(from, axis))
    if vectors.length(side) < 0.05 then side = vectors.cross(axis, { 0.3, 1, 0.2 }) end
    local distance = (options.wide or 4.2) * radius / (2 * math.tan(math.rad(15)))
    local eye = vectors.plus(center, vectors.unit(side), distance)
    return lissom.camera{ eye = eye, target = center, up = options.up or "y" }
end

local function check(options, known)
    for key in pairs(options) do
        if not known[key] then
            lissom.error{ message = "unknown option '" .. tostring(key) .. "' of 'write'", level = 3 }
        end
    end
end

local function draw(options)
    print(lissom.render(options))
end

local picture_options = {
    name = true, out = true, mesh = true, report = true, parts = true, view = true, up = true, from = true,
    seam = true, wide = true, size = true,
}

--- Writes four pictures of a merge: NAME_before.png, the source and the targets as they were cut, each at
-- its own scale; NAME.png, the result in two colours and in one; NAME_wire.png and NAME_seam.png, the seam
-- close up with its edges and without. Options: name; mesh, report and parts as merging.join returns them;
-- out, the folder (default "out"); view and up as of lissom.render; from, seam and wide as of
-- merge_pictures.seam_camera; size, of a cell in pixels (default 640).
function merge_pictures.write(options)
    check(options, picture_options)
    local cell = options.size or 640
    local file = (options.out or "out") .. "/" .. options.name
    local before, captions = { plain(options.parts.source) }, { "source" }
    for i, target in ipairs(options.parts.targets) do
        table.insert(before, plain(target))
        table.insert(captions, #options.parts.targets > 1 and "target " .. i or "target")
    end
    draw{ meshes = before, captions = captions, columns = math.min(#before, 3), fit = "each",
        view = options.view, up = options.up, boundaries = true, size = { cell * math.min(#before, 3),
        cell * math.ceil(#before / 3) }, file = file .. "_before.png" }
    local colored, clay = merge_pictures.colored(options.mesh, options.report), plain(options.mesh)
    draw{ meshes = { colored, clay }, columns = 2, view = options.view, up = options.up,
        size = { 2 * cell, cell }, file = file .. ".png" }
    local camera = merge_pictures.seam_camera(options.report, { seam = options.seam, from = options.from,
        wide = options.wide, up = options.up })
    draw{ mesh = colored, camera = camera, wire = true, size = { cell, cell }, file = file .. "_wire.png" }
    draw{ mesh = clay, camera = camera, size = { cell, cell }, file = file .. "_seam.png" }
end

return merge_pictures
