-- Tools of a hand in a page, by the host that all hosts use (lissom.tool_host). They work on a scene of the
-- picture that is shown: the scene that the script returned, else one of its meshes, hair and styles.
-- `playground.hand(place, inputs)` does the inputs of a hand and returns the picture after them, with marks,
-- values and steps.
local lissom = require "lissom"

local playground = _G.playground
local hosts = {}                    -- by the place of the picture

-- ---- The scene

local function free_name(scene, name)
    local taken = {}
    for _, known in ipairs(scene:names()) do taken[known] = true end
    if not taken[name] then return name end
    local number = 2
    while taken[name .. " " .. number] do number = number + 1 end
    return name .. " " .. number
end

-- Meshes of a picture in columns stand side by side.
local function offset_in_row(picture, place, x)
    local one = picture.meshes[place]
    if not picture.columns or #picture.meshes < 2 then return one.offset, x end
    local box = one.mesh:bounds()
    local width = box and box.max[1] - box.min[1] or 0
    return { x - (box and box.min[1] or 0), 0, 0 }, x + 1.15 * width
end

local function matrix_of(offset, transform)
    if not offset then return transform end
    return { { 1, 0, 0, offset[1] }, { 0, 1, 0, offset[2] }, { 0, 0, 1, offset[3] }, { 0, 0, 0, 1 } }
end

-- The styles of a picture; else those that the script returned, whose head the picture shows.
local function styles_of(picture)
    if picture.styles and #picture.styles > 0 then return picture.styles end
    local list, hashes = {}, {}
    for _, one in ipairs(picture.meshes) do hashes[one.mesh:hash()] = true end
    for _, style in ipairs(playground.styles) do
        if hashes[style:head():hash()] then list[#list + 1] = style end
    end
    return list
end

-- A scene shows the head of a style by that.
local function is_head(styles, mesh)
    for _, style in ipairs(styles) do
        if style:head():hash() == mesh:hash() then return true end
    end
    return false
end

-- Tools take the hair of this name for grown from the style, and take its place.
local function hair_name(scene)
    local first = scene:names()[1]
    if not first then return "hair" end
    return scene:info(first).kind == "hairstyle" and first .. " hair" or first .. " style hair"
end

local function scene_of(picture)
    if picture.scene then return picture.scene end
    local scene, x, styles = lissom.scene{}, 0, styles_of(picture)
    for _, style in ipairs(styles) do scene:add(free_name(scene, "style"), style) end
    for i, one in ipairs(picture.meshes) do
        local offset
        offset, x = offset_in_row(picture, i, x)
        if not is_head(styles, one.mesh) then
            scene:add(free_name(scene, "mesh"), one.mesh, { transform = matrix_of(offset, one.transform) })
        end
    end
    for _, strands in ipairs(picture.strands) do scene:add(free_name(scene, hair_name(scene)), strands) end
    return scene
end

local function host_of(place)
    if hosts[place] then return hosts[place] end
    local picture = playground.drawn[place]
    if not picture then lissom.error{ message = "the script has shown nothing for a tool to work on" } end
    local scene = scene_of(picture)
    scene:clear_history()
    -- The head of a style is another object than the drawn one.
    local colors = {}
    for _, one in ipairs(picture.meshes) do
        colors[one.mesh], colors[one.mesh:hash()] = one.color, one.color
    end
    hosts[place] = { picture = picture, colors = colors, tools = {}, host = lissom.tool_host{ scene = scene,
        camera = lissom.camera{ eye = { 0, 0, 5 } }, up = picture.up == "z" and "z" or "y" } }
    return hosts[place]
end

-- ---- The hand

local does = {}

function does.use(state, input)
    state.word = input.tool ~= "" and input.tool or nil
    local tool = state.tools[input.tool]
    if not tool and state.word then
        tool = lissom.load_tool(input.tool)
        state.tools[input.tool] = tool
    end
    state.host:use(tool)
end

function does.look(state, input)
    state.host:look(lissom.camera{ eye = input.eye, target = input.target, up = input.up, fov = input.fov },
        input.size)
end

function does.set(state, input) state.host:set{ [input.name] = input.value } end

for _, name in ipairs{ "press", "move", "release", "wheel", "key", "tick" } do
    does[name] = function(state, input) state.host[name](state.host, input.event) end
end
for _, name in ipairs{ "cancel", "undo", "redo" } do
    does[name] = function(state) state.host[name](state.host) end
end

-- ---- Marks, with lists of points as numbers in a row

local function is_finite(x) return x - x == 0 end

local function row(points)
    local numbers, width = {}, points[1] and #points[1] or 0
    for _, point in ipairs(points) do
        local whole = true
        for i = 1, width do whole = whole and is_finite(point[i]) end
        for i = 1, whole and width or 0 do numbers[#numbers + 1] = point[i] end
    end
    return numbers
end

local function rows(list, ...)
    for _, mark in ipairs(list) do
        for i = 1, select("#", ...) do
            local key = select(i, ...)
            mark[key] = row(mark[key])
        end
    end
    return list
end

local function marks_of(marks)
    return { points = rows(marks.points, "points"), lines = rows(marks.lines, "points"),
        outlines = rows(marks.outlines, "pixels"), surfaces = rows(marks.surfaces, "from", "to"),
        labels = marks.labels, circles = marks.circles }
end

-- ---- The picture

-- Colours over a mesh: the selected vertices, and those that the tool marks.
local function parts_of(mesh, marks)
    local parts = {}
    local selected = lissom.try(mesh.region, mesh, "selected")
    if selected and #selected > 0 then parts[1] = { region = selected, color = "region", is_kept = true } end
    for _, mark in ipairs(marks.regions) do
        if rawequal(mark.mesh, mesh) then
            parts[#parts + 1] = { region = mark.region, color = mark.color or "region" }
        end
    end
    return parts
end

-- A text that changes with the look of a mesh; its own regions are in its hash.
local function key_of(mesh, parts, color)
    local words = { mesh:hash(), tostring(color) }
    for _, part in ipairs(parts) do
        if not part.is_kept then
            words[#words + 1] = part.color .. table.concat(part.region:vertices(), " ")
        end
    end
    return table.concat(words, "|")
end

local function mesh_of(state, one, marks)
    local parts = parts_of(one.mesh, marks)
    local color = state.colors[one.mesh] or one.color or state.colors[one.mesh:hash()]
    return { mesh = one.mesh, color = color, transform = one.transform, parts = parts,
        key = key_of(one.mesh, parts, color) }
end

local function picture_of(state, marks)
    local picture = playground.scene_picture(state.host.scene)
    local seen = { meshes = {}, strands = {}, lines = picture.lines, hair = state.picture.hair or {},
        wire = state.picture.wire, flat = state.picture.flat, crease = state.picture.crease }
    for _, one in ipairs(picture.meshes) do
        seen.meshes[#seen.meshes + 1] = mesh_of(state, one, marks)
    end
    for _, mark in ipairs(marks.meshes) do
        seen.meshes[#seen.meshes + 1] = { mesh = mark.mesh, transform = mark.transform, color = mark.color,
            raised = true, key = key_of(mark.mesh, {}, mark.color) }
    end
    for _, strands in ipairs(picture.strands) do
        seen.strands[#seen.strands + 1] = { strands = strands, key = strands:hash() }
    end
    return seen
end

-- ---- The answer

local shown_fields = { "name", "type", "default", "value", "min", "max", "step", "choices", "unit", "help",
    "group" }

local function parameters_of(tool)
    local list = {}
    for _, one in ipairs(tool and tool.params:schema() or {}) do
        local copy = {}
        for _, key in ipairs(shown_fields) do
            local value = one[key]
            if type(value) ~= "number" or is_finite(value) then copy[key] = value end
        end
        list[#list + 1] = copy
    end
    return list
end

-- The camera that the tool looks by, if it has chosen one.
local function looked(host)
    if not host.looked then return nil end
    host.looked = nil
    local camera = host.camera
    return { eye = camera:eye(), target = camera:target(), up = camera:up(), fov = camera:fov() }
end

local function steps_of(scene)
    local history = scene:history()
    local function named(place) return history[place] and history[place].name or nil end
    return { undo = named(history.place), redo = named(history.place + 1), count = #history }
end

local function told(failures, problem)
    local is_error = type(problem) == "userdata" or type(problem) == "table"
    failures[#failures + 1] = { message = tostring(problem), code = is_error and problem.code or nil }
end

function playground.hand(place, inputs)
    local state, failures = host_of(place), {}
    for _, input in ipairs(inputs) do
        local done, problem = pcall(does[input.kind], state, input)
        if not done then told(failures, problem) end
    end
    local host, marks = state.host, nil
    local drawn, problem = pcall(host.draw, host)
    if drawn then marks = problem else told(failures, problem) end
    marks = marks or { points = {}, lines = {}, outlines = {}, surfaces = {}, labels = {}, circles = {},
        regions = {}, meshes = {} }
    return { failures = failures, picture = picture_of(state, marks), marks = marks_of(marks),
        tool = host.tool and host.tool.name, prompt = host:prompt(), parameters = parameters_of(host.tool),
        camera = looked(host), steps = steps_of(host.scene), held = host.held ~= nil,
        ticks = host.tool ~= nil and host.tool.tick ~= nil }
end
