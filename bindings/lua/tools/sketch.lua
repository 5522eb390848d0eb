-- ---- Sketching a style: strokes of the tools without a window.

local stroke_fields = set_of{ "tool", "points", "key", "camera", "params", "shift", "ctrl", "alt" }

local function refuse_stroke(i, text, code) fail(string.format("stroke %d: %s", i, text), code) end

local function is_finite(x) return type(x) == "number" and math.abs(x) < math.huge end

-- Message of a tool, without the place in its file: the stroke is the part that the script can
-- change.
local function without_place(message)
    return (tostring(message):gsub("^[^\n]-:%d+: ", ""))
end

local function check_stroke(i, stroke)
    if type(stroke) ~= "table" then refuse_stroke(i, "a stroke is a table") end
    for key in pairs(stroke) do
        if not stroke_fields[key] then
            refuse_stroke(i, "there is no field '" .. tostring(key) .. "'" .. hint(key, stroke_fields))
        end
    end
    local tool, params = stroke.tool, stroke.params
    if tool ~= nil and type(tool) ~= "string" and not is_tool(tool) then
        refuse_stroke(i, "its tool is a name, or a result of lissom.tool")
    end
    if params ~= nil and type(params) ~= "table" then refuse_stroke(i, "its params are a table of values") end
    if stroke.camera ~= nil and type(stroke.camera) ~= "userdata" then
        refuse_stroke(i, "its camera is a result of lissom.camera")
    end
    local points = stroke.points
    if (points ~= nil) == (stroke.key ~= nil) then refuse_stroke(i, "give its points, or a key") end
    if points == nil then return end
    if type(points) ~= "table" or #points == 0 then
        refuse_stroke(i, "its points are a list of pixels {x, y}")
    end
    for k, pixel in ipairs(points) do
        if type(pixel) ~= "table" or not (is_finite(pixel[1]) and is_finite(pixel[2])) then
            refuse_stroke(i, "point " .. k .. " is not a pixel {x, y}")
        end
    end
end

local function grows_hair(tool)
    for _, p in ipairs(tool.params:schema()) do
        if p.name == "strands" then return true end
    end
    return false
end

-- Takes the tool, the camera and the parameters that a stroke names; the others stay.
local function prepare(host, stroke, strands, tools)
    if stroke.camera then host:look(stroke.camera) end
    local wanted = stroke.tool
    if type(wanted) == "string" then
        tools[wanted] = tools[wanted] or load_tool(wanted)
        wanted = tools[wanted]
    end
    if wanted and host.tool ~= wanted then
        host:use(wanted)
        if grows_hair(wanted) then host:set{ strands = strands } end
    end
    if not host.tool then fail("it names no tool, and there is none before it") end
    if stroke.params then host:set(stroke.params) end
end

local function draw_stroke(host, stroke)
    local held = { shift = stroke.shift or false, ctrl = stroke.ctrl or false, alt = stroke.alt or false }
    local function at(pixel)
        return { x = pixel[1], y = pixel[2], shift = held.shift, ctrl = held.ctrl, alt = held.alt }
    end
    if stroke.key then
        host:key{ key = stroke.key, shift = held.shift, ctrl = held.ctrl, alt = held.alt }
        return
    end
    host:press(at(stroke.points[1]))
    for i = 2, #stroke.points do host:move(at(stroke.points[i])) end
    host:release(at(stroke.points[#stroke.points]))
end

local function new_curves(style, known)
    local list = {}
    for _, curve in ipairs(style:curves()) do
        local is_new = true
        for _, old in ipairs(known) do is_new = is_new and old ~= curve end
        if is_new then table.insert(list, curve) end
    end
    return list
end

local function done_by(host, style, stroke)
    local known, before = style:curves(), host.scene:hash()
    draw_stroke(host, stroke)
    return { tool = host.tool.name, added = new_curves(style, known),
        changed = host.scene:hash() ~= before }
end

local function sketch(style, strokes, options)
    for i, stroke in ipairs(strokes) do check_stroke(i, stroke) end
    if #strokes == 0 then return {} end
    local camera = options.camera or strokes[1].camera
    if not camera then refuse_stroke(1, "it needs a camera") end
    local scene = lissom.scene{}
    scene:add("style", style)
    scene:clear_history()
    local host, tools, done = make_host{ scene = scene, camera = camera, size = options.size }, {}, {}
    for i, stroke in ipairs(strokes) do
        local drawn, result = pcall(function()
            prepare(host, stroke, options.strands, tools)
            return done_by(host, style, stroke)
        end)
        if not drawn then
            while scene:undo() do end
            refuse_stroke(i, without_place(result), type(result) == "table" and result.code or nil)
        end
        done[i] = result
    end
    return done, (try(scene.get, scene, "style hair"))
end

