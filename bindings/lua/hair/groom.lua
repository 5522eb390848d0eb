-- Grooms: layers of hair, each of a style and an ordered stack of operators. It returns the functions that
-- the binding calls; its reference is in groom.cpp.
local lissom, described = ...

local function fail(text, code) lissom.error{ message = text, code = code or "invalid_argument" } end

local Groom = { __name = "lissom.Groom" }
Groom.__index = function(_, key)
    local method = rawget(Groom, key)
    if method == nil then fail("lissom.Groom: no field or method '" .. tostring(key) .. "'") end
    return method
end
Groom.__tostring = function(groom) return "lissom.Groom: " .. #rawget(groom, "layers") .. " layers" end

-- Operators by name, and the object of the layer's style that they need.
local operators = {
    guides = "", gather = "", twist = "", pinch = "", curl = "", wave = "", frizz = "", clump = "",
    detail = "", noise = "", smooth = "", straighten = "", rotate = "", roll = "", puff = "", displace = "",
    set_length = "", trim = "", cull = "", blend = "", duplicate = "", taper = "", resample = "",
    set_widths = "", set_colors = "", push_out = "head", shrinkwrap = "head", attach = "head",
    cut = "scalp", braid = "scalp", bun = "scalp", feed_braid = "scalp",
}

local operator_names = {}
for name in pairs(operators) do operator_names[#operator_names + 1] = name end
table.sort(operator_names)

local braids = { braid = true, bun = true, feed_braid = true }

-- ---- JSON, with sorted keys, so that equal values have equal texts

local escapes = { ['"'] = '\\"', ["\\"] = "\\\\", ["\n"] = "\\n", ["\r"] = "\\r", ["\t"] = "\\t" }

local function quoted(text)
    return '"' .. text:gsub('[%c"\\]', function(c)
        return escapes[c] or string.format("\\u%04x", c:byte())
    end) .. '"'
end

local function number_text(value, where)
    if value ~= value or value == math.huge or value == -math.huge then
        fail(where .. " is no finite number")
    end
    return (string.format("%.17g", value):gsub(",", "."))
end

local function sorted_keys(t, where)
    local keys = {}
    for key in pairs(t) do
        if type(key) ~= "string" then
            fail(where .. " mixes a list with names; give a list, or names with values")
        end
        keys[#keys + 1] = key
    end
    table.sort(keys)
    return keys
end

-- `other(value, where)` gives the text of values that JSON does not know.
local function to_json(value, where, other)
    local kind = type(value)
    if kind == "boolean" then return tostring(value) end
    if kind == "string" then return quoted(value) end
    if kind == "number" then return number_text(value, where) end
    if kind ~= "table" then return other(value, where) end
    local parts = {}
    if #value > 0 or next(value) == nil then
        for i = 1, #value do parts[i] = to_json(value[i], where .. "[" .. i .. "]", other) end
        return "[" .. table.concat(parts, ", ") .. "]"
    end
    for i, key in ipairs(sorted_keys(value, where)) do
        parts[i] = quoted(key) .. ": " .. to_json(value[key], where .. "." .. key, other)
    end
    return "{" .. table.concat(parts, ", ") .. "}"
end

local function refuse_to_save(value, where)
    fail(where .. " is a " .. type(value) .. ", which a groom cannot save: give numbers or text")
end

-- Functions and objects are known by themselves as long as the groom lives.
local function by_identity(groom)
    return function(value)
        local ids = groom.ids
        if not ids[value] then
            ids.count = ids.count + 1
            ids[value] = ids.count
        end
        return "<" .. ids[value] .. ">"
    end
end

local deepest = 100

local function unreadable(text, at, what)
    local _, lines = text:sub(1, at):gsub("\n", "")
    lissom.error{ message = "the groom is no JSON at byte " .. at .. ": " .. what, code = "file_syntax",
        line = lines + 1 }
end

local function utf8_of(code)
    if code < 0x80 then return string.char(code) end
    if code < 0x800 then return string.char(0xc0 + math.floor(code / 64), 0x80 + code % 64) end
    return string.char(0xe0 + math.floor(code / 4096), 0x80 + math.floor(code / 64) % 64, 0x80 + code % 64)
end

local function read_string(text, at)
    local parts, from = {}, at + 1
    while true do
        local stop = text:find('["\\]', from)
        if not stop then unreadable(text, at, "a text does not end") end
        parts[#parts + 1] = text:sub(from, stop - 1)
        if text:sub(stop, stop) == '"' then return table.concat(parts), stop + 1 end
        local c = text:sub(stop + 1, stop + 1)
        from = stop + 2
        if c == "u" then
            local digits = text:match("^%x%x%x%x", from) or unreadable(text, from, "no four digits")
            c, from = utf8_of(tonumber(digits, 16)), from + 4
        end
        parts[#parts + 1] = ({ n = "\n", r = "\r", t = "\t", b = "\b", f = "\f" })[c] or c
    end
end

local read_value

-- The members of a list or an object up to `close`. A style is kept as it is written.
local function read_members(text, at, close, depth)
    local made = {}
    at = text:match("^%s*()", at + 1)
    while text:sub(at, at) ~= close do
        local key = #made + 1
        if close == "}" then
            if text:sub(at, at) ~= '"' then unreadable(text, at, "a name is missing") end
            key, at = read_string(text, at)
            at = text:match("^%s*:%s*()", at) or unreadable(text, at, "':' is missing")
        end
        local from = at
        made[key], at = read_value(text, at, depth + 1)
        if key == "style" then made[key] = text:sub(from, at - 1) end
        local comma, after = text:match("^%s*(,?)%s*()", at)
        if comma == "" and text:sub(after, after) ~= close then
            unreadable(text, after, "',' or '" .. close .. "' is missing")
        end
        at = after
    end
    return made, at + 1
end

function read_value(text, at, depth)
    if depth > deepest then unreadable(text, at, "it is nested too deeply") end
    local c = text:sub(at, at)
    if c == "{" then return read_members(text, at, "}", depth) end
    if c == "[" then return read_members(text, at, "]", depth) end
    if c == '"' then return read_string(text, at) end
    local word, stop = text:match("^([%w%.%+%-]+)()", at)
    if word == "true" or word == "false" then return word == "true", stop end
    local value = word and tonumber(word)
    if not value or value ~= value then unreadable(text, at, "a value is missing") end
    return value, stop
end

-- ---- Layers

local function copied(value)
    if type(value) ~= "table" then return value end
    local made = {}
    for key, one in pairs(value) do made[key] = copied(one) end
    return made
end

local function require_operator(operator, where)
    local name = type(operator) == "table" and operator[1]
    if type(name) ~= "string" then
        fail(where .. ' must begin with the name of an operator, as { "curl", radius = 0.01 }')
    end
    if not operators[name] then
        fail(where .. ": there is no operator '" .. name .. "'; there are "
            .. table.concat(operator_names, ", "))
    end
end

-- Numbers for the vertices of a head, from numbers, a function or a region.
local function by_vertex(value, head, where)
    local count = head:vertex_count()
    local numbers = {}
    if type(value) == "table" then
        if #value ~= count then
            fail(where .. " has " .. #value .. " numbers, but the head has " .. count ..
                " vertices: numbers fit the head that they were made for alone")
        end
        return copied(value)
    elseif type(value) == "function" then
        for v = 1, count do
            local x, y, z = head:position(v)
            local answer = value(v, x, y, z)
            numbers[v] = answer == true and 1 or answer or 0
        end
    elseif type(value) == "userdata" then
        if value:mesh() ~= head then
            fail(where .. " is a region of another mesh than the groom's head")
        end
        for v = 1, count do numbers[v] = 0 end
        for _, v in ipairs(value:vertices()) do numbers[v] = 1 end
    else
        fail(where .. " must be numbers, a function or a region, not a " .. type(value))
    end
    return numbers
end

local function largest(numbers)
    local most = 0
    for _, x in ipairs(numbers) do most = math.max(most, x) end
    return most
end

local function product(a, b)
    local made = {}
    for i = 1, #a do made[i] = a[i] * (b and b[i] or 1) end
    return made
end

-- Options of the growth, with numbers in place of functions: these are asked once.
local function growth_of(options, mask, head, where)
    local grow = copied(options or {})
    for _, name in ipairs{ "lengths", "density" } do
        if grow[name] and type(grow[name]) ~= "string" then
            grow[name] = by_vertex(grow[name], head, where .. "." .. name)
        end
    end
    if type(grow.length) == "function" then
        local metres = by_vertex(grow.length, head, where .. ".length")
        grow.length = largest(metres)
        for v, length in ipairs(metres) do metres[v] = grow.length > 0 and length / grow.length or 0 end
        grow.lengths = product(metres, grow.lengths)
    end
    if not mask then return grow end
    if type(grow.density) == "string" then
        fail(where .. ".density must be numbers, as the layer has a mask")
    end
    local numbers = by_vertex(mask, head, where:gsub("grow$", "mask"))
    if largest(numbers) <= 0 then
        fail("no vertex of the head is in the mask of " .. where:gsub(".grow$", ""))
    end
    grow.density = product(numbers, grow.density)
    return grow
end

local layer_keys = { name = "string", style = "userdata", mask = "any", grow = "table", operators = "table",
    on = "boolean", over = "boolean", gap = "number", collide = "boolean" }

local function require_layer(one, where)
    if type(one) ~= "table" then fail(where .. " must be a table") end
    for key, value in pairs(one) do
        local kind = layer_keys[key]
        if not kind then fail(where .. " has no option '" .. tostring(key) .. "'") end
        if kind ~= "any" and type(value) ~= kind then
            local wanted = kind == "userdata" and "lissom.Hairstyle" or kind
            fail(where .. "." .. key .. " must be a " .. wanted .. ", not a " .. type(value))
        end
    end
    if not one.style then fail(where .. " needs a style, a lissom.Hairstyle") end
    if one.gap and not (one.gap >= 0 and one.gap < math.huge) then
        fail(where .. ".gap must not be negative")
    end
end

local function layer_of(one, i, head)
    local where = "layer " .. i
    require_layer(one, where)
    if one.style:head() ~= head then
        fail(where .. " has a style on another head than the groom's: make the style on that head")
    end
    local layer = { name = one.name or where, style = one.style, operators = {}, on = one.on ~= false,
        over = one.over ~= false, gap = one.gap or 0.001, collide = one.collide ~= false, cache = {} }
    layer.grow = growth_of(one.grow, one.mask, head, where .. ".grow")
    for k, operator in ipairs(one.operators or {}) do
        require_operator(operator, where .. ": operator " .. k)
        layer.operators[k] = copied(operator)
    end
    return layer
end

local function groom_of(head, list)
    local ids = setmetatable({ count = 0 }, { __mode = "k" })
    local groom = { head = head, layers = {}, evaluated = 0, ids = ids, shown = false, from = false }
    local names = {}
    for i, one in ipairs(list) do
        local layer = layer_of(one, i, head)
        if names[layer.name] then fail("two layers of a groom are called '" .. layer.name .. "'") end
        names[layer.name] = true
        groom.layers[i] = layer
    end
    if #groom.layers == 0 then fail("a groom needs at least one layer") end
    return setmetatable(groom, Groom)
end

-- ---- Text of a groom

-- Without the end of line of its file.
local function style_text(style) return (style:text():gsub("%s+$", "")) end

local function operator_text(operator, where)
    local options = copied(operator)
    options.operator, options[1] = operator[1], nil
    return to_json(options, where, refuse_to_save)
end

local function layer_text(layer)
    local lines = {}
    for k, operator in ipairs(layer.operators) do
        lines[k] = "\n    " .. operator_text(operator, layer.name .. ": operator " .. k)
    end
    return '{"name": ' .. quoted(layer.name) .. ', "on": ' .. tostring(layer.on) .. ', "over": '
        .. tostring(layer.over) .. ', "collide": ' .. tostring(layer.collide) .. ', "gap": '
        .. number_text(layer.gap, "gap") .. ',\n  "grow": '
        .. to_json(layer.grow, layer.name .. ".grow", refuse_to_save):gsub("^%[%]$", "{}")
        .. ',\n  "operators": [' .. table.concat(lines, ",") .. '],\n  "style": '
        .. style_text(layer.style) .. "}"
end

local function text_of(groom)
    local layers = {}
    for i, layer in ipairs(groom.layers) do layers[i] = layer_text(layer) end
    return '{"format": "lissom groom", "version": 1, "layers": [\n' .. table.concat(layers, ",\n") .. "]}\n"
end

local function content_of(text)
    local content, stop = read_value(text, text:match("^%s*()"), 0)
    if text:find("%S", stop) then unreadable(text, stop, "more follows after its end") end
    if type(content) ~= "table" or content.format ~= "lissom groom" or type(content.layers) ~= "table" then
        fail("this is no groom: its format is not \"lissom groom\"", "file_syntax")
    end
    if content.version ~= 1 then
        fail("the groom has the version " .. tostring(content.version) .. "; this program reads 1",
            "unsupported")
    end
    return content
end

-- Layers of a text; a style that is as in the text stays the object that it is.
local function layers_of(content, head, present, scalp)
    local layers = {}
    for i, one in ipairs(content.layers) do
        local layer = { name = one.name, on = one.on, over = one.over, gap = one.gap, collide = one.collide,
            grow = one.grow, operators = {} }
        local style = present and present[one.name]
        if type(one.style) ~= "string" then
            fail("layer " .. i .. " of the groom has no style", "file_syntax")
        end
        if style and style_text(style) == one.style then
            layer.style = style
        else
            layer.style = lissom.read_style(one.style, head, { scalp = style and style:scalp() or scalp })
        end
        for k, operator in ipairs(type(one.operators) == "table" and one.operators or {}) do
            local made = copied(operator)
            made[1], made.operator = operator.operator, nil
            layer.operators[k] = made
        end
        layers[i] = layer
    end
    return layers
end

-- ---- Hair in a scene: its comment is the text of the groom, so that undo takes both back.

local function sync(groom)
    local shown = groom.shown
    if not shown then return end
    local text = shown.hair:comment()
    if text == shown.text then return end
    shown.text = text
    if text == "" then return end
    local present, caches = {}, {}
    for _, layer in ipairs(groom.layers) do
        present[layer.name], caches[layer.name] = layer.style, layer.cache
    end
    local again = groom_of(groom.head, layers_of(content_of(text), groom.head, present))
    for _, layer in ipairs(again.layers) do layer.cache = caches[layer.name] or {} end
    groom.layers = again.layers
end

-- ---- Evaluation

-- The curve of a style that a braid follows: the one of this name, else its first ponytail, or nil.
local function followed(style, name)
    for _, curve in ipairs(style:curves()) do
        if name and curve:name() == name or not name and curve:kind() == "ponytail" then return curve end
    end
    if name then
        fail("the style has no curve '" .. name .. "' for a braid to follow", "out_of_range")
    end
end

-- The points of a curve from `start` metres behind its beginning on: a tail begins in the head.
local function from_tie(curve, scalp, start)
    local points, made, way = curve:points(), {}, 0
    for i, p in ipairs(points) do
        local q, last = scalp:to_metres(p), i > 1 and scalp:to_metres(points[i - 1])
        if last then
            way = way + math.sqrt((q[1] - last[1]) ^ 2 + (q[2] - last[2]) ^ 2 + (q[3] - last[3]) ^ 2)
        end
        if way >= start then made[#made + 1] = p end
    end
    return #made > 1 and made or points
end

-- Braids and buns without a place of their own follow a curve of their style.
local tie_start = 0.02
local function lay_along_curve(layer, name, options)
    local curve_name = options.along
    options.along = nil
    if options.spine or options.center then return end
    local curve = followed(layer.style, curve_name)
    if not curve then return end
    local scalp = options.scalp
    local points = from_tie(curve, scalp, curve:kind() == "ponytail" and tie_start or 0)
    if name == "bun" then
        local a, b = points[1], points[2]
        options.center = a
        options.direction = options.direction or { b[1] - a[1], b[2] - a[2], b[3] - a[3] }
    else
        options.spine, options.across = points, options.across or scalp:left()
    end
end

local function apply(layer, hair, operator)
    local options = copied(operator)
    options[1], options.off = nil, nil
    local need = operators[operator[1]]
    if need == "head" then options.head = options.head or layer.style end
    if need == "scalp" then options.scalp = options.scalp or layer.style:scalp() end
    if braids[operator[1]] then lay_along_curve(layer, operator[1], options) end
    hair[operator[1]](hair, options)
    -- Copies are made off the surface.
    if operator[1] == "duplicate" then hair:attach{ head = layer.style } end
end

-- Whether hair may be in the head after an operator that moves it; nil if it moves none.
local may_collide = { grow = false, push_out = false, shrinkwrap = false }
for _, name in ipairs{ "gather", "twist", "pinch", "curl", "wave", "frizz", "detail", "clump", "noise",
    "smooth", "straighten", "rotate", "roll", "puff", "displace", "set_length", "blend", "duplicate",
    "resample", "attach", "braid", "bun", "feed_braid" } do
    may_collide[name] = true
end

-- The steps of a layer over `lower`, hair of the layers below it or nil, whose steps have the text `below`:
-- each has a text of all that its result follows from besides the step before, and makes it.
local function steps_of(groom, layer, lower, below)
    local identity, last = by_identity(groom), "grow"
    local steps = { {
        key = to_json(layer.grow, layer.name .. ".grow", identity) .. layer.style:text() .. groom.head:hash()
            .. identity(layer.style),
        make = function() return layer.style:grow(copied(layer.grow)) end,
    } }
    for k, operator in ipairs(layer.operators) do
        if not operator.off then
            if may_collide[operator[1]] ~= nil then last = operator[1] end
            local options = copied(operator)
            options[1], options.off = nil, nil
            steps[#steps + 1] = {
                key = operator[1] .. to_json(options, layer.name .. ": operator " .. k, identity),
                make = function(hair) apply(layer, hair, operator) end,
            }
        end
    end
    if layer.collide and not (lower and layer.over) and may_collide[last] then
        steps[#steps + 1] = {
            key = "collide",
            make = function(hair) hair:push_out{ head = layer.style, clearance = 0.0005 } end,
        }
    end
    if lower and layer.over then
        steps[#steps + 1] = {
            key = "over " .. layer.gap .. below,
            make = function(hair)
                hair:push_out{ head = layer.style, layer = lower, clearance = layer.gap }
            end,
        }
    end
    return steps
end

-- The hair of a layer from the last step on whose result still holds, and the text of all its steps.
local function evaluate(groom, layer, lower, below)
    local steps, cache = steps_of(groom, layer, lower, below), layer.cache
    local good = 0
    while cache[good + 1] and steps[good + 1] and cache[good + 1].key == steps[good + 1].key do
        good = good + 1
    end
    for k = #cache, good + 1, -1 do cache[k] = nil end
    local keys = {}
    for k, step in ipairs(steps) do
        keys[k] = step.key
        if k > good then
            local hair
            if k == 1 then
                hair = step.make()
            else
                hair = cache[k - 1].hair:copy()
                step.make(hair)
            end
            groom.evaluated = groom.evaluated + 1
            cache[k] = { key = step.key, hair = hair }
        end
    end
    return cache[#steps].hair, table.concat(keys, "\n")
end

local function hair_of(groom)
    local all, below = nil, ""
    for _, layer in ipairs(groom.layers) do
        if layer.on then
            local hair, key = evaluate(groom, layer, all, below)
            if all then all:append(hair) else all = hair:copy() end
            below = below .. "\n" .. key
        end
    end
    return all or fail("all layers of the groom are off: switch one on")
end

-- ---- Methods

local function find_layer(groom, which)
    sync(groom)
    for i, layer in ipairs(groom.layers) do
        if i == which or layer.name == which then return layer end
    end
    fail("the groom has no layer '" .. tostring(which) .. "'", "out_of_range")
end

local function operator_at(layer, k)
    return layer.operators[k]
        or fail("layer '" .. layer.name .. "' has no operator " .. tostring(k), "out_of_range")
end

-- Methods return the groom, unless they say else.
local methods = {}

function methods.layer(groom, which) return find_layer(groom, which) end

function methods.set(groom, which, k, options)
    local operator = operator_at(find_layer(groom, which), k)
    for key in pairs(options) do
        if type(key) ~= "string" then fail("options of an operator have names") end
    end
    for key, value in pairs(options) do operator[key] = copied(value) end
    return groom
end

function methods.switch(groom, which, k, on)
    local layer = find_layer(groom, which)
    if k then operator_at(layer, k).off = not on or nil else layer.on = on and true or false end
    return groom
end

function methods.insert(groom, which, operator, k)
    require_operator(operator, "a new operator")
    local list = find_layer(groom, which).operators
    table.insert(list, math.min(math.max(k or #list + 1, 1), #list + 1), copied(operator))
    return groom
end

function methods.remove(groom, which, k)
    local layer = find_layer(groom, which)
    operator_at(layer, k)
    table.remove(layer.operators, k)
    return groom
end

function methods.grow(groom, which, options)
    local layer = find_layer(groom, which)
    for key, value in pairs(growth_of(options, nil, groom.head, layer.name .. ".grow")) do
        layer.grow[key] = value
    end
    return groom
end

function methods.operators() return copied(operator_names) end

function methods.options(groom, which, k)
    local layer = find_layer(groom, which)
    local values = k and operator_at(layer, k) or layer.grow
    local list = {}
    for i, one in ipairs(described[k and values[1] or "grow"]) do
        list[i] = copied(one)
        -- Of options with several kinds of values that of another kind is none for a control.
        local fits = one.type == "choice" and "string" or one.type == "integer" and "number" or one.type
        if type(values[one.name]) == fits then list[i].value = values[one.name] end
    end
    return list
end

function methods.hair(groom)
    sync(groom)
    return hair_of(groom)
end

function methods.text(groom)
    sync(groom)
    return text_of(groom)
end

function methods.save(groom, path)
    lissom.save_groom(groom, path)
    return groom
end

-- Hair whose comment is the text of its groom.
local function labelled(groom)
    local hair, text = hair_of(groom), text_of(groom)
    return hair:set_comment(text), text
end

function methods.show(groom, scene, name)
    if groom.shown then fail("the groom is in a scene already") end
    local hair, text = groom.from, groom.from and groom.from:comment()
    if not hair or lissom.try(scene.get, scene, name) ~= hair then
        hair, text = labelled(groom)
        scene:add(name, hair)
    end
    groom.shown = { scene = scene, hair = hair, text = text }
    return groom
end

function methods.update(groom, step)
    sync(groom)
    local shown = groom.shown or fail("the groom is in no scene: call show first")
    local hair, text = labelled(groom)
    shown.scene:step(step or "groom", function() shown.hair:assign(hair) end)
    shown.text = text
    return groom
end

for name, method in pairs(methods) do
    Groom[name] = function(groom, ...)
        if getmetatable(groom) ~= Groom then fail("call groom:" .. name .. " with ':' on a groom") end
        return method(groom, ...)
    end
end

-- ---- Functions

local functions = {}

function functions.new(options)
    if options.hair then
        if options.layers then fail("give either 'layers' or 'hair', which brings its own") end
        local text = options.hair:comment()
        if text == "" then fail("this hair was made by no groom: it has no comment that describes one") end
        local groom = groom_of(options.head, layers_of(content_of(text), options.head, nil, options.scalp))
        groom.from = options.hair
        return groom
    end
    return groom_of(options.head, options.layers or fail("a groom needs 'layers', or 'hair' of a groom"))
end

function functions.read(text, head, scalp)
    return groom_of(head, layers_of(content_of(text), head, nil, scalp))
end

function functions.text(groom)
    if type(groom) ~= "table" or getmetatable(groom) ~= Groom then
        fail("this is no groom of lissom.groom")
    end
    return groom:text()
end

return functions
