--- A bar that bends and a head with hair, in LÖVE 11.
--
-- Beside this file lies the module for LuaJIT, lissom.so; then `love FOLDER` runs it. Positions go straight
-- into the memory of LÖVE's vertex data, as floats.
local ffi = require "ffi"
local lissom = require "lissom"

local bytes_a_float = 4

-- ---- Shaders: y points up in positions that a shader of our own returns.

local surface_shader = [[
    varying vec3 place;
    uniform mat4 view;
    #ifdef VERTEX
    vec4 position(mat4 transform, vec4 vertex) {
        place = (view * vertex).xyz;
        return vec4(place, 1.0);
    }
    #endif
    #ifdef PIXEL
    vec4 effect(vec4 color, Image image, vec2 uv, vec2 pixel) {
        vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
        float light = 0.35 + 0.65 * abs(dot(normal, normalize(vec3(0.4, 0.6, 0.7))));
        return vec4(color.rgb * light, 1.0);
    }
    #endif
]]

-- A ribbon that faces the viewer; light as on a thin cylinder (Kajiya and Kay).
local strand_shader = [[
    varying vec3 along;
    uniform mat4 view;
    uniform vec2 half_width;
    #ifdef VERTEX
    attribute vec3 Tangent;
    attribute float Side;
    vec4 position(mat4 transform, vec4 vertex) {
        vec4 place = view * vertex;
        along = (view * vec4(Tangent, 0.0)).xyz;
        vec2 across = normalize(vec2(-along.y, along.x) + vec2(1e-9, 0.0));
        return vec4(place.xy + Side * half_width * across, place.z, 1.0);
    }
    #endif
    #ifdef PIXEL
    vec4 effect(vec4 color, Image image, vec2 uv, vec2 pixel) {
        float c = dot(normalize(along), normalize(vec3(0.4, 0.6, 0.7)));
        float s = sqrt(max(0.0, 1.0 - c * c));
        return vec4(color.rgb * (0.3 + 0.6 * s) + 0.25 * pow(s, 40.0), 1.0);
    }
    #endif
]]

-- Rows of a matrix that turns about the y axis, then scales, then moves on the screen.
local function view_matrix(turn, scale, right, up)
    local c, s = math.cos(turn), math.sin(turn)
    local wide = love.graphics.getHeight() / love.graphics.getWidth()
    return {
        { wide * scale * c, 0, wide * scale * s, right },
        { 0, scale, 0, up },
        { 0.3 * scale * s, 0, -0.3 * scale * c, 0 },
        { 0, 0, 0, 1 },
    }
end

-- ---- Surfaces

local function corners_of(mesh)
    local faces = mesh:copy():triangulate():faces()
    local data = love.data.newByteData(3 * #faces * bytes_a_float)
    local corners = ffi.cast("uint32_t*", data:getFFIPointer())
    for i, face in ipairs(faces) do
        for k = 1, 3 do corners[3 * (i - 1) + k - 1] = face[k] - 1 end
    end
    return data
end

-- Drawable of a mesh; `update` moves its vertices to their present places.
local function surface(mesh)
    local data = love.data.newByteData(3 * #mesh * bytes_a_float)
    local drawn = love.graphics.newMesh({ { "VertexPosition", "float", 3 } }, #mesh, "triangles", "dynamic")
    drawn:setVertexMap(corners_of(mesh), "uint32")
    local one = { drawn = drawn, data = data }
    function one.update()
        mesh:positions():write_floats(data:getPointer(), data:getSize())
        drawn:setVertices(data)
    end
    one.update()
    return one
end

-- ---- Hair: two vertices a point, each with its place, the tangent and its side.

local function strip_corners(counts)
    local corners, first = {}, 0
    for _, count in ipairs(counts) do
        for i = first, first + count - 2 do
            local a = 2 * i
            for _, corner in ipairs{ a, a + 1, a + 2, a + 1, a + 3, a + 2 } do
                corners[#corners + 1] = corner
            end
        end
        first = first + count
    end
    local data = love.data.newByteData(#corners * bytes_a_float)
    local numbers = ffi.cast("uint32_t*", data:getFFIPointer())
    for i, corner in ipairs(corners) do numbers[i - 1] = corner end
    return data
end

local function set_tangents(vertices, counts)
    local first = 0
    for _, count in ipairs(counts) do
        for i = first, first + count - 1 do
            local from, to = math.max(i - 1, first), math.min(i + 1, first + count - 1)
            for side = 0, 1 do
                local v = vertices + 7 * (2 * i + side)
                for k = 0, 2 do v[3 + k] = vertices[14 * to + k] - vertices[14 * from + k] end
                v[6] = 2 * side - 1
            end
        end
        first = first + count
    end
end

local function strands(hair)
    local points, counts, row = hair:points(), hair:point_counts(), 7 * bytes_a_float
    local data = love.data.newByteData(2 * points:count() * row)
    for side = 0, 1 do
        points:write_floats(data:getPointer(), data:getSize(), { offset = side * row, stride = 2 * row })
    end
    set_tangents(ffi.cast("float*", data:getFFIPointer()), counts)
    local format = { { "VertexPosition", "float", 3 }, { "Tangent", "float", 3 }, { "Side", "float", 1 } }
    local drawn = love.graphics.newMesh(format, 2 * points:count(), "triangles", "static")
    drawn:setVertices(data)
    drawn:setVertexMap(strip_corners(counts), "uint32")
    return { drawn = drawn, data = data }
end

local function grown(head)
    local style = lissom.hairstyle(head, { resolution = 30000 })
    for _, side in ipairs{ -1, 1 } do
        style:add_stream{ points = {
            style:at{ azimuth = 10 * side, elevation = 60, lift = 0.01 },
            style:at{ azimuth = 75 * side, elevation = 35, lift = 0.02 },
            style:at{ azimuth = 90 * side, elevation = -20, lift = 0.02 },
        } }
    end
    style:add_dividing{ points = { style:at{ azimuth = 0, elevation = 40 },
        style:at{ azimuth = 0, elevation = 80 } } }
    return style:grow{ count = 6000, length = 0.25 }
end

-- ---- The game

local bar, deformer, tip, shapes, shaders

function love.load()
    shaders = { surface = love.graphics.newShader(surface_shader),
        strands = love.graphics.newShader(strand_shader) }
    bar = lissom.shapes.bar{ across = 12, along = 100 }
    deformer = lissom.deformer(bar)
    deformer:add_handle(bar:region("bottom"))
    tip = deformer:add_handle(bar:region("top"))
    local head = lissom.shapes.head{ vertices = 8000 }
    shapes = { bar = surface(bar), head = surface(head), hair = strands(grown(head)) }
    love.graphics.setDepthMode("lequal", true)
    love.graphics.setBackgroundColor(0.62, 0.65, 0.7)
end

local time = 0

function love.update(seconds)
    time = time + seconds
    tip:reset():rotate{ axis = { 0, 0, 1 }, angle = 80 * math.sin(time), about = { 0, 0, 0 } }
    deformer:solve()
    shapes.bar.update()
end

local function draw(shape, shader, view, red, green, blue)
    love.graphics.setShader(shader)
    shader:send("view", "row", view)
    love.graphics.setColor(red, green, blue)
    love.graphics.draw(shape.drawn)
end

function love.draw()
    draw(shapes.bar, shaders.surface, view_matrix(0.5, 0.24, -0.45, -0.1), 0.45, 0.62, 0.85)
    local view = view_matrix(0.5, 3.2, 0.45, 0.15)
    draw(shapes.head, shaders.surface, view, 0.85, 0.82, 0.78)
    shaders.strands:send("half_width", { 1 / love.graphics.getWidth(), 1 / love.graphics.getHeight() })
    draw(shapes.hair, shaders.strands, view, 0.42, 0.26, 0.14)
    love.graphics.setShader()
end
