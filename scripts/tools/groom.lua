--- Shows the layers of a groom with their operators, and changes them.
--
-- The panel lists the layers of the groom whose hair is in the scene, each with a switch, and their operators
-- with theirs. `chosen` is the growth of a layer or an operator: its options are sliders below. `add` puts
-- an operator behind the chosen one. Delete takes the chosen operator out, + and - move it down and up. Each
-- change is a step, which undo takes back.
local lissom = require "lissom"

local none = "none"

-- Hair whose comment is the text of a groom, its name and the text; nil if no such hair is to be seen.
local function groomed_hair(scene)
    for _, name in ipairs(scene:names()) do
        local info = scene:info(name)
        if info.kind == "strands" and info.visible then
            local hair = scene:get(name)
            local text = hair:comment()
            if text:find('"lissom groom"', 1, true) then return hair, name, text end
        end
    end
end

-- The first mesh of a scene that the groom was made on: numbers of its layers fit no other.
local function read_groom(scene, hair)
    local problem
    for _, name in ipairs(scene:names()) do
        if scene:info(name).kind == "mesh" then
            local groom, failure = lissom.try(lissom.groom, { head = scene:get(name), hair = hair })
            if groom then return groom end
            problem = failure
        end
    end
    error(problem and problem.message or "the scene has no mesh that the groom could be on", 0)
end

-- The groom in the scene, as it is now; nil if there is none.
local function groom_of(self, scene)
    local hair, name = groomed_hair(scene)
    if not hair then self.state.groom, self.state.hair = nil, nil return end
    if self.state.hair ~= hair then
        self.state.groom = read_groom(scene, hair):show(scene, name)
        self.state.hair = hair
    end
    return self.state.groom
end

-- The layers of a groom that follows undo: asked for by a method, it is as the scene is.
local function layers_of(groom)
    groom:layer(1)
    return groom.layers
end

-- ---- Names in the panel

local function row_name(i, k) return k and string.format("l%d_%02d", i, k) or string.format("l%d", i) end

-- The layer and the place of the operator that a name in the panel begins with.
local function row_of(name)
    local i, k = name:match("^l(%d+)_(%d+)")
    if i then return tonumber(i), tonumber(k) end
    return tonumber(name:match("^l(%d+)"))
end

-- What can be chosen, in the order of the list.
local function choices_of(layers)
    local list = {}
    for i, layer in ipairs(layers) do
        list[#list + 1] = i .. " " .. layer.name .. ": growth"
        for k, operator in ipairs(layer.operators) do
            list[#list + 1] = i .. " " .. layer.name .. ": " .. k .. " " .. operator[1]
        end
    end
    return list
end

-- The layer and the operator of such a choice; nil for the growth.
local function chosen_row(choice)
    return tonumber(choice:match("^%d+")), tonumber(choice:match(": (%d+) [%l_]+$"))
end

local function choice_of(layers, i, k)
    local layer = layers[i]
    local operator = layer.operators[k]
    return i .. " " .. layer.name .. ": " .. (operator and k .. " " .. operator[1] or "growth")
end

-- ---- Parameters

local function add_switches(params, layers)
    for i, layer in ipairs(layers) do
        local group = i .. " " .. layer.name
        params[row_name(i) .. "_on"] = { type = "boolean", default = layer.on, group = group,
            help = "Whether the layer " .. layer.name .. " grows." }
        for k, operator in ipairs(layer.operators) do
            params[row_name(i, k) .. "_" .. operator[1]] = { type = "boolean", default = not operator.off,
                group = group, help = "Whether " .. operator[1] .. " works." }
        end
    end
end

-- Sliders end at four times the usual or present value where an option has no end.
local function add_slider(params, one, group)
    local value = one.value
    if value == nil then value = one.default end
    if value == nil then return end             -- left to the operator
    local low, high = one.min, one.max
    if low and one.above then low = low + 1e-6 end
    if type(value) == "number" and low and not high then high = math.max(4 * value, low + 1e-3) end
    if one.type == "integer" and high then high = math.ceil(high) end
    params["set_" .. one.name] = { type = one.type, default = value, min = low, max = high,
        choices = one.choices, unit = one.unit ~= "" and one.unit or nil, group = group, help = one.help }
end

local function add_sliders(params, groom, layers, choice)
    local i, k = chosen_row(choice)
    for _, one in ipairs(groom:options(i, k)) do add_slider(params, one, "options of " .. choice) end
    local operators = groom:operators()
    table.insert(operators, 1, none)
    params.add = { type = "choice", default = none, choices = operators, group = "more",
        help = "An operator that is put behind the chosen one." }
    params.chosen = { type = "choice", default = choice, choices = choices_of(layers), group = "of",
        help = "What the sliders below are of." }
end

-- Makes the parameters those of the groom as it is.
local function show_groom(self, scene)
    local groom = groom_of(self, scene)
    if not groom then
        if self.state.shown then self.params = lissom.params({}, { command_line = false }) end
        self.state.shown = nil
        return
    end
    local layers = layers_of(groom)
    local i, k = self.state.layer or 1, self.state.operator
    if not layers[i] then i, k = 1, nil end
    if k and not layers[i].operators[k] then k = nil end
    local shown = groom:text() .. i .. "/" .. tostring(k)
    if shown == self.state.shown then return end
    local params = {}
    add_switches(params, layers)
    add_sliders(params, groom, layers, choice_of(layers, i, k))
    self.params = lissom.params(params, { command_line = false })
    self.state.shown, self.state.layer, self.state.operator = shown, i, k
end

-- ---- Changes

local function add_operator(self, groom, name)
    local i, k = self.state.layer, self.state.operator
    local place = k and k + 1 or #layers_of(groom)[i].operators + 1
    groom:insert(i, { name }, place)
    self.state.operator = place
    groom:update("add " .. name)
end

local function set_option(self, groom, name, value)
    local i, k = self.state.layer, self.state.operator
    if k then groom:set(i, k, { [name] = value }) else groom:grow(i, { [name] = value }) end
    groom:update(name)
end

local function change(self, groom, name)
    local value = self.params[name]
    if name == "chosen" then
        self.state.layer, self.state.operator = chosen_row(value)
    elseif name == "add" then
        if value ~= none then add_operator(self, groom, value) end
    elseif name:find("^set_") then
        set_option(self, groom, name:sub(5), value)
    else
        local i, k = row_of(name)
        groom:switch(i, k, value):update(value and "on" or "off")
    end
end

local function move_operator(self, groom, by)
    local i, k = self.state.layer, self.state.operator
    local list = layers_of(groom)[i].operators
    if not k or not list[k + by] then return end
    local operator = list[k]
    groom:remove(i, k):insert(i, operator, k + by):update("order")
    self.state.operator = k + by
end

local function remove_operator(self, groom)
    if not self.state.operator then return end
    groom:remove(self.state.layer, self.state.operator):update("remove")
    self.state.operator = nil
end

-- The groom of a scene, for a change; without one an error with a remedy.
local function need_groom(self, scene)
    return groom_of(self, scene) or error("the scene has no hair of a groom: show one, as "
        .. "lissom.groom{ head = head, layers = layers }:show(scene, 'hair')", 0)
end

return lissom.tool{
    name = "groom",
    help = "The layers of a groom and their operators: switch them, choose one for its sliders, add one. "
        .. "Delete takes the chosen operator out, + and - move it.",
    activate = function(self, ev) show_groom(self, ev.scene) end,
    changed = function(self, ev)
        -- The parameters are those of before if the change fails.
        local done, problem = pcall(change, self, need_groom(self, ev.scene), ev.parameter)
        self.state.shown = nil
        if not done then
            self.state.hair = nil
            show_groom(self, ev.scene)
            error(problem, 0)
        end
        show_groom(self, ev.scene)
    end,
    key = function(self, ev)
        if ev.key == "delete" then remove_operator(self, need_groom(self, ev.scene)) end
        if ev.key == "+" then move_operator(self, need_groom(self, ev.scene), 1) end
        if ev.key == "-" then move_operator(self, need_groom(self, ev.scene), -1) end
        show_groom(self, ev.scene)
    end,
    draw = function(self, view) show_groom(self, view.scene) end,
}
