--- Grooms: layers of hair, each of a style and an ordered stack of operators, that are evaluated again only
-- from the first change on, and saved as JSON.
--
--     local groom = require "groom"
--     local g = groom.new{ head = head, layers = {
--         { name = "all", style = style, grow = { count = 20000, length = 0.2 }, operators = {
--             { "guides", count = 170 }, { "curl", radius = 0.009 }, { "push_out", clearance = 0.001 } } },
--     } }
--     local hair = g:hair()
--     g:set("all", 2, { radius = 0.006 })      -- grows nothing again, and curls and pushes out
--     g:switch("all", 2, false)
--     g:save("out/groom.json")
--
-- Operators are methods of lissom.Strands by name, with their options. Those that need the style or the scalp
-- (push_out, shrinkwrap; cut, braid, bun, feed_braid) get them.
local lissom = require "lissom"

local groom = {}
local Groom = {}
Groom.__index = Groom

local needs = { push_out = "head", shrinkwrap = "head", cut = "scalp", braid = "scalp", bun = "scalp",
    feed_braid = "scalp" }

-- ---- Text of options: JSON with sorted keys, so that equal options have equal texts

local function sorted_keys(t)
    local keys = {}
    for key in pairs(t) do
        if type(key) ~= "string" then
            lissom.error{ message = "options of a groom are lists, or tables with names as keys" }
        end
        keys[#keys + 1] = key
    end
    table.sort(keys)
    return keys
end

local escapes = { ['"'] = '\\"', ["\\"] = "\\\\", ["\n"] = "\\n", ["\r"] = "\\r", ["\t"] = "\\t" }

local function to_json(value, where)
    local kind = type(value)
    if kind == "boolean" then return tostring(value) end
    if kind == "string" then
        return '"' .. value:gsub('[%c"\\]', function(c)
            return escapes[c] or string.format("\\u%04x", c:byte())
        end) .. '"'
    end
    if kind == "number" then
        if value ~= value or value == math.huge or value == -math.huge then
            lissom.error{ message = where .. " is no finite number, which JSON does not know" }
        end
        return (string.format("%.17g", value):gsub(",", "."))
    end
    if kind ~= "table" then
        lissom.error{ message = where .. " is a " .. kind
            .. ", which a groom cannot save: give numbers or text" }
    end
    local parts = {}
    if #value > 0 or next(value) == nil then
        for i = 1, #value do parts[i] = to_json(value[i], where .. "[" .. i .. "]") end
        return "[" .. table.concat(parts, ", ") .. "]"
    end
    for i, key in ipairs(sorted_keys(value)) do
        parts[i] = to_json(key, where) .. ": " .. to_json(value[key], where .. "." .. key)
    end
    return "{" .. table.concat(parts, ", ") .. "}"
end

local read_value

local function read_string(text, at)
    local parts, from = {}, at + 1
    while true do
        local stop = text:find('["\\]', from)
        if not stop then lissom.error{ message = "the groom's file ends in a text" } end
        parts[#parts + 1] = text:sub(from, stop - 1)
        if text:sub(stop, stop) == '"' then return table.concat(parts), stop + 1 end
        local c = text:sub(stop + 1, stop + 1)
        if c == "u" then
            parts[#parts + 1] = string.char(tonumber(text:sub(stop + 2, stop + 5), 16) % 256)
            from = stop + 6
        else
            parts[#parts + 1] = ({ n = "\n", r = "\r", t = "\t" })[c] or c
            from = stop + 2
        end
    end
end

-- Members of a list or an object up to `close`.
local function read_members(text, at, close)
    local made = {}
    at = text:match("^%s*()", at + 1)
    while text:sub(at, at) ~= close do
        local key = #made + 1
        if close == "}" then
            key, at = read_string(text, at)
            at = text:match("^%s*:%s*()", at)
        end
        if not at then lissom.error{ message = "the groom's file is no JSON: ':' is missing" } end
        made[key], at = read_value(text, at)
        at = text:match("^%s*,?%s*()", at)
        if at > #text then lissom.error{ message = "the groom's file ends before '" .. close .. "'" } end
    end
    return made, at + 1
end

function read_value(text, at)
    local c = text:sub(at, at)
    if c == "{" then return read_members(text, at, "}") end
    if c == "[" then return read_members(text, at, "]") end
    if c == '"' then return read_string(text, at) end
    local word, stop = text:match("^([%w%.%+%-]+)()", at)
    local value = ({ ["true"] = true, ["false"] = false })[word]
    if value == nil then value = tonumber(word or "") end
    if value == nil then lissom.error{ message = "the groom's file is no JSON at byte " .. at } end
    return value, stop
end

-- ---- Layers

local function copy(value)
    if type(value) ~= "table" then return value end
    local made = {}
    for key, one in pairs(value) do made[key] = copy(one) end
    return made
end

local function require_operator(operator, where)
    local name = operator[1]
    if type(name) ~= "string" then
        lissom.error{ message = where
            .. ' must begin with the name of an operator, as { "curl", radius = 0.01 }' }
    end
end

local function layer_of(one, i)
    local where = "layer " .. i
    if not one.style then lissom.error{ message = where .. " of a groom needs a style" } end
    local layer = { name = one.name or where, style = one.style, grow = copy(one.grow or {}), operators = {},
        on = one.on ~= false, cache = {} }
    for k, operator in ipairs(one.operators or {}) do
        require_operator(operator, where .. ": operator " .. k)
        layer.operators[k] = copy(operator)
    end
    return layer
end

--- Makes a groom of a head and layers: each has a `style`, the options of its growth (`grow`), a list of
-- `operators`, a `name`, and is left out with `on = false`. The first layer is the lowest.
function groom.new(options)
    local self = setmetatable({ head = options.head, layers = {}, evaluated = 0 }, Groom)
    for i, one in ipairs(options.layers or {}) do
        local layer = layer_of(one, i)
        for _, other in ipairs(self.layers) do
            if other.name == layer.name then
                lissom.error{ message = "two layers of a groom are called '" .. layer.name .. "'" }
            end
        end
        self.layers[i] = layer
    end
    if #self.layers == 0 then lissom.error{ message = "a groom needs at least one layer" } end
    return self
end

--- Returns a layer by its name or number.
function Groom:layer(which)
    for i, layer in ipairs(self.layers) do
        if i == which or layer.name == which then return layer end
    end
    lissom.error{ message = "the groom has no layer '" .. tostring(which) .. "'" }
end

local function operator_at(layer, k)
    local operator = layer.operators[k]
    if not operator then
        lissom.error{ message = "layer '" .. layer.name .. "' has no operator " .. tostring(k) }
    end
    return operator
end

--- Changes options of an operator.
function Groom:set(which, k, options)
    local operator = operator_at(self:layer(which), k)
    for key, value in pairs(options) do
        if key ~= 1 then operator[key] = copy(value) end
    end
    return self
end

--- Switches an operator off or on, or with k = nil the layer.
function Groom:switch(which, k, on)
    local layer = self:layer(which)
    if k then operator_at(layer, k).off = (not on) or nil else layer.on = on end
    return self
end

--- Puts an operator before place k, or after all; and takes one out.
function Groom:insert(which, operator, k)
    require_operator(operator, "a new operator")
    local list = self:layer(which).operators
    table.insert(list, math.min(math.max(k or #list + 1, 1), #list + 1), copy(operator))
    return self
end

function Groom:remove(which, k)
    local layer = self:layer(which)
    operator_at(layer, k)
    table.remove(layer.operators, k)
    return self
end

-- The text of a style, as its file has it.
local function style_text(style)
    local path = os.tmpname()
    style:save(path)
    local file = assert(io.open(path, "rb"))
    local text = file:read("*a")
    file:close()
    os.remove(path)
    return text
end

local function apply(layer, hair, operator)
    local options = copy(operator)
    options[1], options.off = nil, nil
    local need = needs[operator[1]]
    if need == "head" then options.head = options.head or layer.style end
    if need == "scalp" then options.scalp = options.scalp or layer.style:scalp() end
    hair[operator[1]](hair, options)
end

-- Hair of a layer after its operators: from the last state that still holds.
local function evaluate(self, layer)
    local keys = { to_json(layer.grow, layer.name .. ".grow") .. style_text(layer.style) }
    local on = {}
    for k, operator in ipairs(layer.operators) do
        if not operator.off then
            on[#on + 1] = operator
            local options = copy(operator)
            options[1] = nil
            keys[#keys + 1] = operator[1] .. to_json(options, layer.name .. ": operator " .. k)
        end
    end
    local good = 0
    while layer.cache[good + 1] and layer.cache[good + 1].key == keys[good + 1] do good = good + 1 end
    for k = #layer.cache, good + 1, -1 do layer.cache[k] = nil end
    for k = good + 1, #keys do
        local hair = k == 1 and layer.style:grow(copy(layer.grow)) or layer.cache[k - 1].hair:copy()
        if k > 1 then apply(layer, hair, on[k - 1]) end
        self.evaluated = self.evaluated + 1
        layer.cache[k] = { key = keys[k], hair = hair }
    end
    return layer.cache[#keys].hair
end

--- Returns the hair of all layers that are on, evaluated from the first change of each on. `evaluated` counts
-- growths and operators that ran.
function Groom:hair()
    local all
    for _, layer in ipairs(self.layers) do
        if layer.on then
            local hair = evaluate(self, layer):copy()
            all = all and all:append(hair) or hair
        end
    end
    return all or lissom.error{ message = "all layers of the groom are off" }
end

-- ---- Files

--- Writes the groom with its styles as JSON.
function Groom:save(path)
    local layers = {}
    for i, layer in ipairs(self.layers) do
        local operators = {}
        for k, operator in ipairs(layer.operators) do
            local options = copy(operator)
            options.operator, options[1] = operator[1], nil
            operators[k] = to_json(options, layer.name .. ": operator " .. k)
        end
        layers[i] = '{"name": ' .. to_json(layer.name) .. ', "on": ' .. tostring(layer.on) .. ', "grow": '
            .. to_json(layer.grow, layer.name .. ".grow") .. ',\n  "operators": [\n    '
            .. table.concat(operators, ",\n    ") .. '],\n  "style": '
            .. to_json(style_text(layer.style)) .. "}"
    end
    local file, why = io.open(path, "wb")
    if not file then lissom.error{ message = "the groom cannot be written: " .. why } end
    file:write('{"lissom": "groom", "version": 1, "layers": [\n', table.concat(layers, ",\n"), "]}\n")
    file:close()
    return self
end

--- Reads a groom for a head, which may be another than it was made on.
function groom.load(path, head)
    local file, why = io.open(path, "rb")
    if not file then lissom.error{ message = "the groom cannot be read: " .. why } end
    local text = file:read("*a")
    file:close()
    local content = read_value(text, text:match("^%s*()"))
    if type(content) ~= "table" or content.lissom ~= "groom" or content.version ~= 1 then
        lissom.error{ message = path .. " is no groom of version 1" }
    end
    local layers = {}
    for i, one in ipairs(content.layers) do
        local name = os.tmpname()
        local style_file = assert(io.open(name, "wb"))
        style_file:write(one.style)
        style_file:close()
        local style, problem = lissom.load_style(name, head)
        os.remove(name)
        if not style then lissom.error(problem) end
        local operators = {}
        for k, operator in ipairs(one.operators) do
            operator[1], operator.operator = operator.operator, nil
            operators[k] = operator
        end
        layers[i] = { name = one.name, on = one.on, grow = one.grow, operators = operators, style = style }
    end
    return groom.new{ head = head, layers = layers }
end

return groom
