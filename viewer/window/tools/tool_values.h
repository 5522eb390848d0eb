/// Values that pass between C++ and the functions of tools: each type has a `push` and a `read`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bindings/lua/core/compat.h"
#include "bindings/lua/core/script_parameters.h"
#include "kernel/core/geometry.h"
#include "kernel/io/mesh_file.h"
#include "viewer/window/tools/tool_input.h"

namespace lissom::window {

/// A value of the stack.
struct StackValue {
    int index = 0;
};
/// Values of the stack, from the first to the last.
struct StackValues {
    int first = 1, last = 0;
};
/// The value that Lua's registry has under this address.
struct RegistryValue {
    const void* key = nullptr;
};
/// An event of a hand; `is_late` if a later place of the same drag is known already.
struct HandEvent {
    const ToolInput& input;
    bool is_late = false;
};
/// The camera, the size and the up axis of an input of kind `look`.
struct Look {
    const ToolInput& input;
};
/// A parameter of a tool, and its value.
struct ToolSetting {
    const std::string& name;
    const lua::ParameterValue& value;
};

// ---- Each pushes its values and returns their number.

int push(lua_State* L, const char* text);
int push(lua_State* L, const std::string& text);
int push(lua_State* L, bool value);
int push(lua_State* L, lua_Integer value);
int push(lua_State* L, const std::vector<std::string>& list);
/// The options of lissom.load that are not its defaults.
int push(lua_State* L, const LoadOptions& options);
int push(lua_State* L, const StackValue& value);
int push(lua_State* L, const StackValues& values);
int push(lua_State* L, const RegistryValue& value);
int push(lua_State* L, const HandEvent& event);
int push(lua_State* L, const Look& look);
int push(lua_State* L, const ToolSetting& setting);

// ---- Each reads the value at an index without calling anything of the script's; what has another
// type leaves `value` as it is.

void read(lua_State* L, int index, std::string& value);
void read(lua_State* L, int index, std::optional<std::string>& value);
void read(lua_State* L, int index, bool& value);
void read(lua_State* L, int index, double& value);
void read(lua_State* L, int index, std::vector<std::string>& value);
void read(lua_State* L, int index, std::vector<double>& value);
/// Reads three rows of four numbers, or more rows.
void read(lua_State* L, int index, Affine& value);
/// Keeps the value in Lua's registry, under this address.
void read(lua_State* L, int index, const RegistryValue& value);

/// Pushes a field of the table at `index` as it is in the table, or nil.
void push_raw(lua_State* L, int index, const char* key);

/// Reads a field of the table at `index`.
template <typename Value>
void read_field(lua_State* L, int index, const char* key, Value& value) {
    push_raw(L, index, key);
    read(L, lua_gettop(L), value);
    lua_pop(L, 1);
}

}  // namespace lissom::window
