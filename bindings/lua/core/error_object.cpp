#include "bindings/lua/core/error_object.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "bindings/lua/core/call.h"

namespace lissom::lua {
namespace {

// Key of Lua's registry: its address. The metatable of error objects.
const char kErrorMetatable = 0;

void set_text(lua_State* L, const char* field, std::string_view text) {
    lua_pushlstring(L, text.data(), text.size());
    lua_setfield(L, -2, field);
}

void push_number(lua_State* L, std::size_t value) {
    push_integer(L, static_cast<long long>(value));
}

void push_lua_id(lua_State* L, Index id) {
    push_integer(L, static_cast<long long>(id) + 1);
}

// A list of ids, or of pairs for edges.
void push_element_ids(lua_State* L, const Failure& failure) {
    const bool pairs = failure.kind == ElementKind::edge;
    lua_newtable(L);
    for (std::size_t i = 0; i < failure.id_count; ++i) {
        if (!pairs) {
            push_lua_id(L, failure.ids[i]);
            lua_rawseti(L, -2, index_of(i) + 1);
        } else if (i % 2 == 1) {
            lua_createtable(L, 2, 0);
            push_lua_id(L, failure.ids[i - 1]);
            lua_rawseti(L, -2, 1);
            push_lua_id(L, failure.ids[i]);
            lua_rawseti(L, -2, 2);
            lua_rawseti(L, -2, index_of(i / 2) + 1);
        }
    }
}

void set_elements(lua_State* L, const Failure& failure) {
    if (failure.kind == ElementKind::none) return;
    lua_createtable(L, 0, 3);
    set_text(L, "kind", kind_name(failure.kind));
    push_number(L, failure.count);
    lua_setfield(L, -2, "count");
    push_element_ids(L, failure);
    lua_setfield(L, -2, "ids");
    lua_setfield(L, -2, "elements");
}

void set_input(lua_State* L, const Failure& failure) {
    if (failure.file[0] != '\0') set_text(L, "file", failure.file);
    if (failure.line == 0) return;
    push_number(L, failure.line);
    lua_setfield(L, -2, "line");
}

// "script.lua:3"; nothing if no script runs.
void set_place(lua_State* L, int level) {
    luaL_where(L, level);
    if (level == 1 || lua_tostring(L, -1)[0] == '\0') {
        lua_pop(L, 1);
        push_place(L);
    }
    std::size_t size = 0;
    const char* place = lua_tolstring(L, -1, &size);
    if (size > 2) {
        lua_pushlstring(L, place, size - 2);
        lua_setfield(L, -3, "place");
    }
    lua_pop(L, 1);
}

// Pushes a field of the error object, read raw.
int push_field(lua_State* L, int index, const char* name) {
    index = absolute_index(L, index);
    lua_pushstring(L, name);
    lua_rawget(L, index);
    return lua_type(L, -1);
}

int error_to_string(lua_State* L) {
    if (!is_error_object(L, 1) || push_field(L, 1, "message") != LUA_TSTRING) {
        lua_pushliteral(L, "lissom.Error");
    }
    return 1;
}

// Pushes the text of an operand; that of a value without one is its type, not its address.
void push_operand(lua_State* L, int index) {
    const bool has_text = lua_isstring(L, index) || luaL_getmetafield(L, index, "__tostring");
    if (has_text) {
        to_display_string(L, index);
    } else {
        lua_pushstring(L, luaL_typename(L, index));
    }
}

// Pushes the text of a raised value that is no error object; one without a text has no address.
const char* push_other_error(lua_State* L, int index) {
    index = absolute_index(L, index);
    const int kind = lua_type(L, index);
    const bool is_plain =
        kind == LUA_TSTRING || kind == LUA_TNUMBER || kind == LUA_TBOOLEAN || kind == LUA_TNIL;
    if (is_plain) return to_display_string(L, index);
    if (luaL_getmetafield(L, index, "__tostring")) {
        lua_pop(L, 1);
        return to_display_string(L, index);
    }
    lua_pushfstring(L, "the error is a %s without a text", luaL_typename(L, index));
    return lua_tostring(L, -1);
}

int concatenate_error(lua_State* L) {
    lua_settop(L, 2);
    push_operand(L, 1);
    lua_insert(L, 1);
    lua_settop(L, 3);
    push_operand(L, 3);
    lua_replace(L, 2);
    lua_settop(L, 2);
    lua_concat(L, 2);
    return 1;
}

template <typename Enum>
bool is_named(lua_State* L, Enum value, std::string_view (*name_of)(Enum)) {
    return lua_type(L, -1) == LUA_TSTRING && name_of(value) == lua_tostring(L, -1);
}

// The value whose name is on top of the stack, which is popped.
template <typename Enum>
Enum pop_named(lua_State* L, Enum last, Enum usual, std::string_view (*name_of)(Enum)) {
    Enum found = usual;
    for (int i = 0; i <= static_cast<int>(last); ++i) {
        if (is_named(L, static_cast<Enum>(i), name_of)) found = static_cast<Enum>(i);
    }
    lua_pop(L, 1);
    return found;
}

// Ids of the list on top of the stack, and of the lists in it.
void add_ids(lua_State* L, Failure& failure, int depth) {
    for (int i = 1; failure.id_count < Elements::kMaximumIds; ++i) {
        lua_rawgeti(L, -1, i);
        const int type = lua_type(L, -1);
        if (type == LUA_TTABLE && depth > 0) add_ids(L, failure, depth - 1);
        if (type == LUA_TNUMBER) {
            failure.ids[failure.id_count++] = static_cast<Index>(lua_tointeger(L, -1)) - 1;
        }
        lua_pop(L, 1);
        if (type == LUA_TNIL) return;
    }
}

void read_elements(lua_State* L, Failure& failure) {
    push_field(L, -1, "kind");
    failure.kind = pop_named(L, ElementKind::strand, ElementKind::none, kind_name);
    push_field(L, -1, "count");
    failure.count = static_cast<std::size_t>(std::max<lua_Integer>(0, lua_tointeger(L, -1)));
    lua_pop(L, 1);
    if (push_field(L, -1, "ids") == LUA_TTABLE) add_ids(L, failure, 1);
    lua_pop(L, 1);
}

}  // namespace

void open_errors(lua_State* L) {
    lua_createtable(L, 0, 4);
    lua_pushliteral(L, "lissom.Error");
    lua_setfield(L, -2, "__name");
    lua_pushliteral(L, "lissom.Error");
    lua_setfield(L, -2, "__metatable");
    lua_pushcfunction(L, error_to_string);
    lua_setfield(L, -2, "__tostring");
    lua_pushcfunction(L, concatenate_error);
    lua_setfield(L, -2, "__concat");
    raw_set_pointer(L, LUA_REGISTRYINDEX, &kErrorMetatable);
}

void push_error(lua_State* L, const Failure& failure, int level) {
    luaL_checkstack(L, LUA_MINSTACK, "no room for an error");
    lua_createtable(L, 0, 6);
    set_text(L, "message", failure.message);
    set_text(L, "code", code_name(failure.code));
    set_elements(L, failure);
    set_input(L, failure);
    set_place(L, level);
    raw_get_pointer(L, LUA_REGISTRYINDEX, &kErrorMetatable);
    lua_setmetatable(L, -2);
}

void raise_failure(lua_State* L, const Failure& failure) {
    push_error(L, failure);
    lua_error(L);
    std::abort();  // lua_error does not return
}

void raise_misuse(lua_State* L, const char* text) {
    Failure failure;
    failure.set(ErrorCode::invalid_argument, text);
    raise_failure(L, failure);
}

bool is_error_object(lua_State* L, int index) {
    if (lua_type(L, index) != LUA_TTABLE || lua_getmetatable(L, index) == 0) return false;
    raw_get_pointer(L, LUA_REGISTRYINDEX, &kErrorMetatable);
    const bool is = lua_istable(L, -1) && lua_rawequal(L, -1, -2) != 0;
    lua_pop(L, 2);
    return is;
}

void read_error(lua_State* L, int index, Failure& failure) {
    index = absolute_index(L, index);
    push_field(L, index, "code");
    const ErrorCode code = pop_named(L, ErrorCode::internal, ErrorCode::internal, code_name);
    const bool has_text = push_field(L, index, "message") == LUA_TSTRING;
    failure.set(code, has_text ? lua_tostring(L, -1) : "an error without a message");
    lua_pop(L, 1);
    if (push_field(L, index, "elements") == LUA_TTABLE) read_elements(L, failure);
    lua_pop(L, 1);
}

const char* push_error_text(lua_State* L, int index) {
    if (!is_error_object(L, index)) return push_other_error(L, index);
    index = absolute_index(L, index);
    const bool has_place = push_field(L, index, "place") == LUA_TSTRING;
    if (has_place) lua_pushliteral(L, ": ");
    to_display_string(L, index);
    lua_pushliteral(L, " [");
    if (push_field(L, index, "code") != LUA_TSTRING) {
        lua_pop(L, 1);
        lua_pushliteral(L, "internal");
    }
    lua_pushliteral(L, "]");
    if (!has_place) lua_remove(L, -5);
    lua_concat(L, has_place ? 6 : 4);
    return lua_tostring(L, -1);
}

}  // namespace lissom::lua
