// Makes the module and the metatables of a Lua state from its registration table.
#include <cstdio>
#include <cstring>
#include <string>

#include "bindings/lua/core/call.h"
#include "bindings/lua/core/error_object.h"
#include "bindings/lua/core/old_names.h"
#include "kernel/core/nearest.h"

namespace lissom::lua {
namespace {

// Keys of Lua's registry: their addresses.
const char kStateKey = 0, kModuleKey = 0, kListenerKey = 0;

const char kBoxMark = 0;

struct StateBox {
    const void* mark;
    State* state;
};

// Null if the userdata is another.
StateBox* find_box(lua_State* L, int index) {
    if (lua_type(L, index) != LUA_TUSERDATA || raw_length(L, index) != sizeof(StateBox)) {
        return nullptr;
    }
    auto* box = static_cast<StateBox*>(lua_touserdata(L, index));
    return box->mark == &kBoxMark ? box : nullptr;
}

State& state_upvalue(lua_State* L, int i) {
    const StateBox* box = find_box(L, lua_upvalueindex(i));
    if (!box || !box->state) raise_misuse(L, "lissom is closed in this state");
    return *box->state;
}

int collect_state(lua_State* L) {
    if (StateBox* box = find_box(L, 1)) {
        delete box->state;
        box->state = nullptr;
    }
    return 0;
}

// ---- Calls. Upvalues: the description (light), the StateBox, the Type (light) for objects.

const char* effect_name(Effect effect) {
    constexpr const char* kNames[] = {"by_result", "changes", "replaces", "shapes", "unheard"};
    return kNames[static_cast<int>(effect)];
}

bool is_told(const Entry& entry) {
    return entry.function->effect != Effect::unheard && (!entry.type || entry.type->is_heard);
}

// Calls a method of the listener with `count` values from the stack index `first` on.
void tell_listener(lua_State* L, State& state, const char* method, const Entry& entry, int first,
                   int count) {
    luaL_checkstack(L, count + LUA_MINSTACK, "too many values to be heard");
    raw_get_pointer(L, LUA_REGISTRYINDEX, &kListenerKey);
    lua_getfield(L, -1, method);
    lua_insert(L, -2);
    if (entry.type) {
        lua_pushstring(L, entry.type->name.c_str());
    } else {
        lua_pushnil(L);
    }
    lua_pushstring(L, entry.function->name.c_str());
    lua_pushstring(L, effect_name(entry.function->effect));
    for (int i = 0; i < count; ++i) lua_pushvalue(L, first + i);
    state.is_heard = false;
    const int status = lua_pcall(L, count + 4, 0, 0);
    state.is_heard = true;
    if (status != 0) lua_error(L);
}

int dispatch_heard(lua_State* L, State& state, const Entry& entry) {
    tell_listener(L, state, "before", entry, 1, lua_gettop(L));
    Call call(L, state, entry);
    const int results = entry.function->body(call);
    // A body that has yielded has none.
    if (results < 0 || !state.is_heard) return results;
    tell_listener(L, state, "after", entry, lua_gettop(L) - results + 1, results);
    return results;
}

int dispatch(lua_State* L) {
    const auto* entry = static_cast<const Entry*>(lua_touserdata(L, lua_upvalueindex(1)));
    State& state = state_upvalue(L, 2);
    if (state.only_help && (entry->type || entry->function->name != "params")) {
        return end_for_help(L, state);
    }
    if (state.is_heard && is_told(*entry)) return dispatch_heard(L, state, *entry);
    Call call(L, state, *entry);
    return entry->function->body(call);
}

const Type& type_upvalue(lua_State* L) {
    return *static_cast<const Type*>(lua_touserdata(L, lua_upvalueindex(3)));
}

Holder* open_holder(lua_State* L, int index, const Type& type) {
    Holder* holder = find_holder(L, index, type.name.c_str());
    return holder && holder->object ? holder : nullptr;
}

int dispatch_operator(lua_State* L) {
    const auto* op = static_cast<const Operator*>(lua_touserdata(L, lua_upvalueindex(1)));
    State& state = state_upvalue(L, 2);
    const Type& type = type_upvalue(L);
    if (!open_holder(L, 1, type)) {
        const char* got =
            find_holder(L, 1, type.name.c_str()) ? "a closed one" : luaL_typename(L, 1);
        raise_misuse(L, lua_pushfstring(L, "bad operand of '%s' (%s expected, got %s)",
                                        op->name.c_str(), type.name.c_str(), got));
    }
    Call call(L, state, *op);
    return op->body(call);
}

int equal_objects(lua_State* L) {
    const Type& type = type_upvalue(L);
    if (open_holder(L, 1, type) && open_holder(L, 2, type)) return dispatch_operator(L);
    lua_pushboolean(L, 0);
    return 1;
}

int object_to_string(lua_State* L) {
    const Type& type = type_upvalue(L);
    const Holder* holder = find_holder(L, 1, type.name.c_str());
    if (holder && !holder->object) {
        lua_pushfstring(L, "%s (closed)", type.name.c_str());
        return 1;
    }
    if (holder && lua_touserdata(L, lua_upvalueindex(1))) return dispatch_operator(L);
    lua_pushstring(L, type.name.c_str());
    return 1;
}

// ---- Names that do not exist.

// "mesh:transform{ rotate = ... }" if `name` is an option of a method, or "".
std::string call_with_option(const Type& type, std::string_view name) {
    for (const Function& method : type.methods) {
        for (const Parameter& option : method.options) {
            if (option.name != name) continue;
            return variable_name(type) + ":" + method.name + "{ " + option.name + " = ... }";
        }
    }
    return "";
}

std::string missing_method_text(const Type& type, const char* name) {
    const std::string old = old_name_hint(OldKind::method, type.name, name);
    if (!old.empty()) return type.name + ": no method '" + name + "'" + old;
    const std::string call = call_with_option(type, name);
    if (!call.empty()) return type.name + ": no method '" + name + "'; write " + call;
    std::vector<std::string_view> names{"close"};
    for (const Function& method : type.methods) names.push_back(method.name);
    for (const Result& field : type.fields) names.push_back(field.name);
    return type.name + (type.fields.empty() ? ": no method '" : ": no field or method '") + name +
           "'" + name_hint(name, names);
}

std::string missing_function_text(const Registry& registry, const std::string& prefix,
                                  const char* name) {
    std::vector<std::string_view> names;
    const auto add = [&](const std::string& full) {
        if (full.compare(0, prefix.size(), prefix) != 0) return;
        const std::string_view rest = std::string_view(full).substr(prefix.size());
        const std::string_view first = rest.substr(0, rest.find('.'));
        if (names.empty() || names.back() != first) names.push_back(first);
    };
    for (const auto& library : registry.libraries()) {
        for (const Constant& constant : library->constants) add(constant.name);
        for (const Function& function : library->functions) add(function.name);
    }
    const std::string table = "lissom" + (prefix.empty() ? "" : "." + prefix);
    const std::string old = old_name_hint(OldKind::function, table, name);
    if (!old.empty()) return table + ": no function '" + name + "'" + old;
    return table.substr(0, table.size() - (prefix.empty() ? 0 : 1)) + ": no function '" + name +
           "'" + name_hint(name, names);
}

const char* push_key_text(lua_State* L) {
    // Other values would show their addresses.
    const bool has_text = lua_isstring(L, 2) || lua_isboolean(L, 2);
    return has_text ? to_display_string(L, 2) : luaL_typename(L, 2);
}

template <typename Compose>
int raise_missing(lua_State* L, const Compose& compose) {
    char text[2048];
    Failure failure;
    const bool composed = failure.guard(
        [&] { std::snprintf(text, sizeof text, "%s", std::string(compose()).c_str()); });
    raise_misuse(L, composed ? text : failure.message);
}

int missing_method(lua_State* L) {
    const Type& type = type_upvalue(L);
    const char* name = push_key_text(L);
    return raise_missing(L, [&] { return missing_method_text(type, name); });
}

// Upvalues: the prefix ("" or "shapes."), the StateBox.
int missing_function(lua_State* L) {
    const State& state = state_upvalue(L, 2);
    const char* prefix = lua_tostring(L, lua_upvalueindex(1));
    const char* name = push_key_text(L);
    return raise_missing(L, [&] { return missing_function_text(*state.registry, prefix, name); });
}

// ---- Life of objects.

int collect_object(lua_State* L) {
    Holder* holder = find_holder(L, 1, nullptr);
    if (!holder) return 0;
    const StateBox* box = find_box(L, lua_upvalueindex(2));
    if (!box || !box->state) return 0;
    if (holder->object && box->state->listeners->running) {
        keep_collected(L, *box->state->listeners);
    } else {
        holder->object.end();
    }
    return 0;
}

int close_object(lua_State* L) {
    const Type& type = type_upvalue(L);
    Holder* holder = find_holder(L, 1, type.name.c_str());
    if (!holder) {
        raise_misuse(L, lua_pushfstring(L, "bad argument #1 to 'close' (%s expected, got %s)",
                                        type.name.c_str(), luaL_typename(L, 1)));
    }
    if (state_upvalue(L, 2).listeners->running) {
        raise_misuse(L, "a listener cannot close objects while an operation runs");
    }
    if (holder->object && type.close) type.close(holder->object.get());
    holder->object.reset();
    return 0;
}

// ---- Tables. `box` is the stack index of the StateBox.

void push_closure(lua_State* L, lua_CFunction function, const void* description, int box,
                  const Type* type) {
    lua_pushlightuserdata(L, const_cast<void*>(description));
    lua_pushvalue(L, box);
    lua_pushlightuserdata(L, const_cast<Type*>(type));
    lua_pushcclosure(L, function, 3);
}

const Operator* find_operator(const Type& type, const char* name) {
    for (const Operator& op : type.operators) {
        if (op.name == name) return &op;
    }
    return nullptr;
}

// An "__index" operator is asked first; keys that it does not know are looked up among the methods
// (upvalue 4).
int index_object(lua_State* L) {
    if (open_holder(L, 1, type_upvalue(L))) {
        const int results = dispatch_operator(L);
        if (results > 0) return results;
    }
    lua_settop(L, 2);
    lua_gettable(L, lua_upvalueindex(4));
    return 1;
}

void push_methods(lua_State* L, const Registry& registry, const Type& type, int box) {
    lua_newtable(L);
    for (const auto& entry : registry.entries()) {
        if (entry->type != &type) continue;
        push_closure(L, dispatch, entry.get(), box, &type);
        lua_setfield(L, -2, entry->function->name.c_str());
    }
    push_closure(L, close_object, nullptr, box, &type);
    lua_setfield(L, -2, "close");
    lua_newtable(L);
    push_closure(L, missing_method, nullptr, box, &type);
    lua_setfield(L, -2, "__index");
    lua_setmetatable(L, -2);
}

// Sets __index of the metatable on top of the stack.
void set_index(lua_State* L, const Registry& registry, const Type& type, int box) {
    const Operator* index = find_operator(type, "__index");
    if (!index) {
        push_methods(L, registry, type, box);
    } else {
        lua_pushlightuserdata(L, const_cast<Operator*>(index));
        lua_pushvalue(L, box);
        lua_pushlightuserdata(L, const_cast<Type*>(&type));
        push_methods(L, registry, type, box);
        lua_pushcclosure(L, index_object, 4);
    }
    lua_setfield(L, -2, "__index");
}

void make_metatable(lua_State* L, const Registry& registry, const Type& type, int box) {
    luaL_newmetatable(L, type.name.c_str());
    lua_pushstring(L, type.name.c_str());
    lua_setfield(L, -2, "__name");
    // Scripts cannot put a finalizer of their own there.
    lua_pushstring(L, type.name.c_str());
    lua_setfield(L, -2, "__metatable");
    for (const Operator& op : type.operators) {
        if (op.name == "__index" || op.name == "__tostring") continue;
        push_closure(L, op.name == "__eq" ? equal_objects : dispatch_operator, &op, box, &type);
        lua_setfield(L, -2, op.name.c_str());
    }
    push_closure(L, object_to_string, find_operator(type, "__tostring"), box, &type);
    lua_setfield(L, -2, "__tostring");
    push_closure(L, collect_object, nullptr, box, &type);
    lua_setfield(L, -2, "__gc");
    push_closure(L, close_object, nullptr, box, &type);
    lua_setfield(L, -2, "__close");
    set_index(L, registry, type, box);
    lua_pop(L, 1);
}

// Pushes the table of `module` that holds the name `path` ("shapes.box": lissom.shapes), made if it
// is missing, and returns the part after the last dot.
const char* push_table_for(lua_State* L, int module, const char* path, int box) {
    const char* dot = std::strrchr(path, '.');
    lua_pushvalue(L, module);
    if (!dot) return path;
    lua_pushlstring(L, path, dot - path);
    lua_rawget(L, module);
    if (lua_isnil(L, -1)) {
        lua_pop(L, 1);
        lua_newtable(L);
        lua_newtable(L);
        lua_pushlstring(L, path, at(dot - path) + 1);
        lua_pushvalue(L, box);
        lua_pushcclosure(L, missing_function, 2);
        lua_setfield(L, -2, "__index");
        lua_setmetatable(L, -2);
        lua_pushlstring(L, path, dot - path);
        lua_pushvalue(L, -2);
        lua_rawset(L, module);
    }
    lua_remove(L, -2);
    return dot + 1;
}

void push_module(lua_State* L, const Registry& registry, int box) {
    lua_newtable(L);
    const int module = lua_gettop(L);
    for (const auto& library : registry.libraries()) {
        for (const Constant& constant : library->constants) {
            lua_pushstring(L, constant.value.c_str());
            lua_setfield(L, module, constant.name.c_str());
        }
    }
    for (const auto& entry : registry.entries()) {
        if (entry->type) continue;
        const char* name = push_table_for(L, module, entry->function->name.c_str(), box);
        push_closure(L, dispatch, entry.get(), box, nullptr);
        lua_setfield(L, -2, name);
        lua_pop(L, 1);
    }
    lua_newtable(L);
    lua_pushliteral(L, "");
    lua_pushvalue(L, box);
    lua_pushcclosure(L, missing_function, 2);
    lua_setfield(L, -2, "__index");
    lua_setmetatable(L, module);
}

// Hides the metatable on top of the stack from getmetatable.
void hide_metatable(lua_State* L) {
    lua_pushboolean(L, 0);
    lua_setfield(L, -2, "__metatable");
}

// Pushes the StateBox with a new State.
State& push_state(lua_State* L, const HostOptions& options) {
    auto* box = static_cast<StateBox*>(new_userdata(L, sizeof(StateBox)));
    *box = {&kBoxMark, nullptr};
    lua_createtable(L, 0, 2);
    lua_pushcfunction(L, collect_state);
    lua_setfield(L, -2, "__gc");
    hide_metatable(L);
    lua_setmetatable(L, -2);
    Failure failure;
    if (!failure.guard([&] { box->state = new State(options); })) {
        luaL_error(L, "cannot open lissom: %s", failure.message);
    }
    return *box->state;
}

void make_object_table(lua_State* L) {
    lua_newtable(L);
    lua_createtable(L, 0, 1);
    lua_pushliteral(L, "v");
    lua_setfield(L, -2, "__mode");
    lua_setmetatable(L, -2);
    raw_set_pointer(L, LUA_REGISTRYINDEX, State::object_table_key());
}

void make_held_metatable(lua_State* L) {
    lua_createtable(L, 0, 2);
    lua_pushcfunction(L, collect_held);
    lua_setfield(L, -2, "__gc");
    hide_metatable(L);
    raw_set_pointer(L, LUA_REGISTRYINDEX, State::held_metatable_key());
}

}  // namespace

void open(lua_State* L, const HostOptions& options) {
    luaL_checkstack(L, LUA_MINSTACK, "cannot open lissom");
    raw_get_pointer(L, LUA_REGISTRYINDEX, &kModuleKey);
    if (lua_istable(L, -1)) return;
    lua_pop(L, 1);
    const State& state = push_state(L, options);
    const int box = lua_gettop(L);
    open_errors(L);
    open_listeners(L, *state.listeners);
    make_object_table(L);
    make_held_metatable(L);
    for (const auto& library : state.registry->libraries()) {
        for (const Type& type : library->types) make_metatable(L, *state.registry, type, box);
    }
    push_module(L, *state.registry, box);
    lua_pushvalue(L, box);
    raw_set_pointer(L, LUA_REGISTRYINDEX, &kStateKey);
    lua_pushvalue(L, -1);
    raw_set_pointer(L, LUA_REGISTRYINDEX, &kModuleKey);
    lua_remove(L, box);
}

int hear_calls(lua_State* L) {
    State* state = find_state(L);
    if (!state) return 0;
    lua_settop(L, 1);
    state->is_heard = lua_istable(L, 1);
    raw_set_pointer(L, LUA_REGISTRYINDEX, &kListenerKey);
    return 0;
}

const Entry* find_entry(lua_State* L, int index) {
    if (lua_tocfunction(L, index) != dispatch || !lua_getupvalue(L, index, 1)) return nullptr;
    const auto* entry = static_cast<const Entry*>(lua_touserdata(L, -1));
    lua_pop(L, 1);
    return entry;
}

const Type* find_type(lua_State* L, int index) {
    const State* state = find_state(L);
    if (!state || lua_type(L, index) != LUA_TUSERDATA) return nullptr;
    for (const auto& library : state->registry->libraries()) {
        for (const Type& type : library->types) {
            if (luaL_testudata(L, index, type.name.c_str())) return &type;
        }
    }
    return nullptr;
}

State* find_state(lua_State* L) {
    raw_get_pointer(L, LUA_REGISTRYINDEX, &kStateKey);
    const StateBox* box = find_box(L, -1);
    lua_pop(L, 1);
    return box ? box->state : nullptr;
}

}  // namespace lissom::lua
