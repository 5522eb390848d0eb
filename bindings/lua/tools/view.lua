-- ---- What is drawn over the picture

local view_fields = {
    points = { points = "list", color = "color", radius = "number" },
    line = { points = "list", color = "color", width = "number", closed = "boolean" },
    label = { at = "point", text = "string", color = "color" },
    outline = { pixels = "list", color = "color", width = "number", closed = "boolean", opacity = "number" },
    circle = { at = "point", color = "color", radius = "number" },
    region = { mesh = "userdata", region = "userdata", color = "color" },
    surface = { from = "list", to = "list", color = "color", opacity = "number" },
    mesh = { mesh = "userdata", transform = "matrix", color = "color" },
}
local needed = { points = "points", line = "points", label = "at", outline = "pixels", circle = "at",
    region = "region", surface = "from", mesh = "mesh" }

local function is_point(value, count)
    if type(value) ~= "table" then return false end
    for i = 1, count do
        if type(value[i]) ~= "number" then return false end
    end
    return true
end

local checks = {
    number = function(value) return type(value) == "number" and value >= 0 and value < math.huge end,
    boolean = function(value) return type(value) == "boolean" end,
    string = function(value) return type(value) == "string" end,
    userdata = function(value) return type(value) == "userdata" end,
    color = function(value) return type(value) == "string" and value:match("^#%x%x%x%x%x%x$") ~= nil end,
    point = is_point,
    matrix = function(value)
        if type(value) ~= "table" then return false end
        return is_point(value[1], 4) and is_point(value[2], 4) and is_point(value[3], 4)
    end,
    list = function(value, count)
        if type(value) ~= "table" then return false end
        for _, point in ipairs(value) do
            if not is_point(point, count) then return false end
        end
        return true
    end,
}

-- What other drawing tools call the options.
local usual_names = { center = "at", centre = "at", position = "at", pos = "at", point = "at",
    size = "radius", r = "radius", thickness = "width", colour = "color", alpha = "opacity", label = "text",
    vertices = "points", matrix = "transform" }

local function option_hint(key, fields)
    local usual = usual_names[key]
    return usual and fields[usual] and ", did you mean '" .. usual .. "'?" or hint(key, fields)
end

local function checked(what, given)
    if type(given) ~= "table" then error("view:" .. what .. " takes a table of options", 3) end
    local fields, copy = view_fields[what], {}
    local count = (what == "outline" or what == "circle") and 2 or 3
    for key, value in pairs(given) do
        if not fields[key] then
            local name = "'" .. tostring(key) .. "'"
            error("view:" .. what .. " has no option " .. name .. option_hint(key, fields), 3)
        end
        if not checks[fields[key]](value, count) then
            error("bad option '" .. key .. "' of view:" .. what .. " (" .. fields[key] .. " expected)", 3)
        end
        copy[key] = value
    end
    if given[needed[what]] == nil then error("view:" .. what .. " needs '" .. needed[what] .. "'", 3) end
    return copy
end

local function put(view, list, what, given)
    table.insert(view.list[list], checked(what, given))
    return view
end

function View:points(given) return put(self, "points", "points", given) end
function View:line(given) return put(self, "lines", "line", given) end
function View:curve(given) return put(self, "lines", "line", given) end
function View:label(given) return put(self, "labels", "label", given) end
function View:outline(given) return put(self, "outlines", "outline", given) end
function View:circle(given) return put(self, "circles", "circle", given) end

function View:surface(given)
    local from, to = type(given) == "table" and given.from, type(given) == "table" and given.to
    if type(from) == "table" and (type(to) ~= "table" or #from ~= #to) then
        error("view:surface takes as many points in 'to' as in 'from'", 2)
    end
    return put(self, "surfaces", "surface", given)
end

function View:region(given) return put(self, "regions", "region", given) end
function View:mesh(given) return put(self, "meshes", "mesh", given) end

function View:handle(given)
    local point = { points = { given.at }, color = given.color or "#e8a33d", radius = given.radius or 7 }
    return put(self, "points", "points", point)
end

local function hexadecimal(color)
    local function byte(value) return math.floor(255 * math.max(0, math.min(1, value)) + 0.5) end
    return string.format("#%02x%02x%02x", byte(color[1]), byte(color[2]), byte(color[3]))
end

local hover_color = "#ffd24a"

-- The part `chosen` is drawn as the one in hand.
function View:gizmo(gizmo, chosen)
    local cursor = self.cursor and { x = self.cursor[1], y = self.cursor[2] } or nil
    local shape = gizmo:shape(self.camera, self.size, cursor)
    for _, line in ipairs(shape.lines) do
        local color = line.part == chosen and hover_color or hexadecimal(line.color)
        self:line{ points = line.points, closed = line.closed, width = line.width, color = color }
    end
    for _, point in ipairs(shape.points) do
        local color = point.part == chosen and hover_color or hexadecimal(point.color)
        self:points{ points = { point.position }, radius = point.radius, color = color }
    end
    return self
end

-- The points of the boundary that was hit, where its object stands.
local function points_of(scene, hit)
    local place = hit.object and scene:info(hit.object).transform
    local points = {}
    for i, v in ipairs(hit.boundary:vertices()) do
        local x, y, z = hit.mesh:position(v)
        points[i] = { x, y, z }
        for row = 1, place and 3 or 0 do
            local m = place[row]
            points[i][row] = m[1] * x + m[2] * y + m[3] * z + m[4]
        end
    end
    return points
end

-- Shows what a click would answer.
local function draw_hover(view, host)
    local hit, request = host.hover, host.request
    if not hit or not request then return end
    if hit.object and not try(host.scene.info, host.scene, hit.object) then return end
    if request.kind == "boundary" then
        view:line{ points = points_of(host.scene, hit), closed = true, color = hover_color, width = 5 }
    else
        view:points{ points = { hit.position }, color = hover_color, radius = 6 }
    end
end

function Host:draw()
    self:ready()
    local view = setmetatable({ camera = self.camera, scene = self.scene, size = self.size,
        up = self:up_axis(), cursor = self.x and { self.x, self.y } or nil,
        list = { points = {}, lines = {}, labels = {}, outlines = {}, circles = {}, regions = {},
            surfaces = {}, meshes = {} } }, View)
    draw_hover(view, self)
    local draw = self.tool and self.tool.draw
    -- One that was stopped from outside never came to its end: only another tool draws again.
    if not draw or rawequal(self.draws, self.tool) then return view.list end
    self.working, self.draws = true, self.tool
    local before = self.scene:depth()
    self.scene:begin("draw")
    local outer = guard(self.scene, before + 1)
    local done, message = pcall(draw, self.tool, view)
    self.working, self.draws = false, nil
    guard(self.scene, outer)
    local whole = self.scene:depth() == before + 1
    local changed = whole and self.scene:commit()
    while self.scene:depth() > before do self.scene:rollback() end
    if done and whole and not changed then return view.list end
    if changed and before == 0 then self.scene:undo() end
    if done then
        message = new_error("the tool '" .. self.tool.name .. "' changed the scene while it was drawn")
    end
    self:fail(message)
end

function Host:prompt()
    local request = self.request
    if not request then return self.tool and self.tool.help or nil end
    if request.kind ~= "number" then return request.prompt end
    return request.prompt .. " " .. (self.typed ~= "" and self.typed or tostring(request.default or ""))
end

