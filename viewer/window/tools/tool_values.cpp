#include "viewer/window/tools/tool_values.h"

#include <array>
#include <variant>

#include "bindings/lua/core/call.h"
#include "bindings/lua/tools/tools.h"

namespace lissom::window {
namespace {

constexpr std::array kButtonNames{"left", "right", "middle"};

template <typename Visit>
void for_each_item(lua_State* L, int list, const Visit& visit) {
    const std::size_t length = lua_istable(L, list) ? lua::raw_length(L, list) : 0;
    for (std::size_t i = 0; i < length; ++i) {
        lua_rawgeti(L, list, static_cast<int>(i) + 1);
        visit();
        lua_pop(L, 1);
    }
}

template <typename Value>
void set_field(lua_State* L, const char* key, const Value& value) {
    push(L, value);
    lua_setfield(L, -2, key);
}

void set_number(lua_State* L, const char* key, double value) {
    lua_pushnumber(L, value);
    lua_setfield(L, -2, key);
}

void set_numbers(lua_State* L, const char* key, std::initializer_list<double> values) {
    lua_createtable(L, static_cast<int>(values.size()), 0);
    int place = 0;
    for (const double value : values) {
        lua_pushnumber(L, value);
        lua_rawseti(L, -2, ++place);
    }
    lua_setfield(L, -2, key);
}

void set_vector(lua_State* L, const char* key, const Vec3& value) {
    set_numbers(L, key, {value.x(), value.y(), value.z()});
}

using EventValue = std::variant<std::monostate, bool, double, std::string>;

// Returns the value of a field of an event; nothing if the event has none.
EventValue event_value(const HandEvent& event, const std::string& field) {
    const ToolInput& input = event.input;
    const auto flag = [](bool down) { return down ? EventValue(true) : EventValue(); };
    if (field == "x") return input.at.x();
    if (field == "y") return input.at.y();
    if (field == "lines") return input.lines;
    if (field == "seconds") return input.seconds;
    if (field == "key") return input.key;
    if (field == "shift") return flag(input.modifiers.shift);
    if (field == "ctrl") return flag(input.modifiers.ctrl);
    if (field == "alt") return flag(input.modifiers.alt);
    if (field == "late") return flag(event.is_late);
    if (field != "button" || input.kind != ToolInput::Kind::press) return {};
    return std::string(kButtonNames[static_cast<std::size_t>(input.button)]);
}

lua::EventKind kind_of(const ToolInput& input) {
    if (input.kind == ToolInput::Kind::key) return lua::EventKind::key;
    if (input.kind == ToolInput::Kind::wheel) return lua::EventKind::wheel;
    if (input.kind == ToolInput::Kind::tick) return lua::EventKind::clock;
    return lua::EventKind::mouse;
}

}  // namespace

int push(lua_State* L, const char* text) {
    lua_pushstring(L, text);
    return 1;
}

int push(lua_State* L, const std::string& text) {
    lua_pushlstring(L, text.data(), text.size());
    return 1;
}

int push(lua_State* L, bool value) {
    lua_pushboolean(L, value ? 1 : 0);
    return 1;
}

int push(lua_State* L, lua_Integer value) {
    lua_pushinteger(L, value);
    return 1;
}

int push(lua_State* L, const std::vector<std::string>& list) {
    lua_createtable(L, static_cast<int>(list.size()), 0);
    for (std::size_t i = 0; i < list.size(); ++i) {
        push(L, list[i]);
        lua_rawseti(L, -2, static_cast<int>(i) + 1);
    }
    return 1;
}

int push(lua_State* L, const LoadOptions& options) {
    lua_newtable(L);
    if (options.weld == Weld::seams) set_field(L, "weld", "seams");
    if (options.weld == Weld::all) set_field(L, "weld", "all");
    if (options.weld == Weld::none) set_field(L, "weld", "none");
    if (options.up != UpAxis::none) set_field(L, "up", options.up == UpAxis::y ? "y" : "z");
    if (options.unit != 1.0) set_number(L, "unit", options.unit);
    if (!options.repair) set_field(L, "repair", false);
    return 1;
}

int push(lua_State* L, const StackValue& value) {
    lua_pushvalue(L, value.index);
    return 1;
}

int push(lua_State* L, const StackValues& values) {
    for (int i = values.first; i <= values.last; ++i) lua_pushvalue(L, i);
    return values.last - values.first + 1;
}

int push(lua_State* L, const RegistryValue& value) {
    lua::raw_get_pointer(L, LUA_REGISTRYINDEX, value.key);
    return 1;
}

int push(lua_State* L, const HandEvent& event) {
    lua_newtable(L);
    for (const lua::Parameter& field : lua::event_fields(kind_of(event.input))) {
        const EventValue value = event_value(event, field.name);
        const char* const name = field.name.c_str();
        if (const auto* flag = std::get_if<bool>(&value)) set_field(L, name, *flag);
        if (const auto* number = std::get_if<double>(&value)) set_number(L, name, *number);
        if (const auto* text = std::get_if<std::string>(&value)) set_field(L, name, *text);
    }
    return 1;
}

int push(lua_State* L, const Look& look) {
    const Camera& camera = look.input.camera;
    lua_newtable(L);
    set_vector(L, "eye", camera.eye());
    set_vector(L, "target", camera.target());
    set_vector(L, "up", camera.up());
    if (camera.is_ortho()) {
        set_number(L, "ortho", *camera.options().ortho);
    } else {
        set_number(L, "fov", camera.fov() / kDegree);
    }
    lua_createtable(L, 2, 0);
    lua_pushinteger(L, look.input.size.width);
    lua_rawseti(L, -2, 1);
    lua_pushinteger(L, look.input.size.height);
    lua_rawseti(L, -2, 2);
    lua_setfield(L, -2, "size");
    if (look.input.up == ViewUp::z) set_field(L, "z_up", true);
    return 1;
}

int push(lua_State* L, const ToolSetting& setting) {
    lua_newtable(L);
    const char* const name = setting.name.c_str();
    if (const auto* flag = std::get_if<bool>(&setting.value)) set_field(L, name, *flag);
    if (const auto* number = std::get_if<double>(&setting.value)) set_number(L, name, *number);
    if (const auto* text = std::get_if<std::string>(&setting.value)) set_field(L, name, *text);
    return 1;
}

void read(lua_State* L, int index, std::string& value) {
    if (lua_type(L, index) == LUA_TSTRING) value = lua_tostring(L, index);
}

void read(lua_State* L, int index, std::optional<std::string>& value) {
    if (lua_type(L, index) == LUA_TSTRING) value = lua_tostring(L, index);
}

void read(lua_State* L, int index, bool& value) {
    value = lua_toboolean(L, index) != 0;
}

void read(lua_State* L, int index, double& value) {
    if (lua_type(L, index) == LUA_TNUMBER) value = lua_tonumber(L, index);
}

void read(lua_State* L, int index, std::vector<std::string>& value) {
    for_each_item(L, index, [&] {
        if (lua_type(L, -1) == LUA_TSTRING) value.emplace_back(lua_tostring(L, -1));
    });
}

void read(lua_State* L, int index, std::vector<double>& value) {
    for_each_item(L, index, [&] { value.push_back(lua_tonumber(L, -1)); });
}

void read(lua_State* L, int index, Affine& value) {
    int row = 0;
    for_each_item(L, index, [&] {
        int column = 0;
        for_each_item(L, lua_gettop(L), [&] {
            if (row < 3 && column < 3) value.linear(row, column) = lua_tonumber(L, -1);
            if (row < 3 && column == 3) value.translation[row] = lua_tonumber(L, -1);
            ++column;
        });
        ++row;
    });
}

void read(lua_State* L, int index, const RegistryValue& value) {
    lua_pushvalue(L, index);
    lua::raw_set_pointer(L, LUA_REGISTRYINDEX, value.key);
}

void push_raw(lua_State* L, int index, const char* key) {
    index = lua::absolute_index(L, index);
    if (!lua_istable(L, index)) return lua_pushnil(L);
    lua_pushstring(L, key);
    lua_rawget(L, index);
}

}  // namespace lissom::window
