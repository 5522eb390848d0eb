/// Lua's C API as this folder uses it: one source for Lua 5.4, its C++ build and LuaJIT (Lua 5.1
/// API).
#pragma once

extern "C" {
#include <lauxlib.h>
#include <lua.h>
#include <lualib.h>
}

#include <cstddef>

namespace lissom::lua {

#if LUA_VERSION_NUM >= 504

inline void* new_userdata(lua_State* L, std::size_t bytes) {
    return lua_newuserdatauv(L, bytes, 0);
}
inline std::size_t raw_length(lua_State* L, int index) {
    return static_cast<std::size_t>(lua_rawlen(L, index));
}
inline int absolute_index(lua_State* L, int index) {
    return lua_absindex(L, index);
}
inline bool is_integer(lua_State* L, int index) {
    return lua_isinteger(L, index) != 0;
}
inline void push_integer(lua_State* L, long long value) {
    lua_pushinteger(L, static_cast<lua_Integer>(value));
}
inline const char* to_display_string(lua_State* L, int index) {
    return luaL_tolstring(L, index, nullptr);
}
inline void raw_get_pointer(lua_State* L, int index, const void* key) {
    lua_rawgetp(L, index, key);
}
inline void raw_set_pointer(lua_State* L, int index, const void* key) {
    lua_rawsetp(L, index, key);
}
inline int load_text_file(lua_State* L, const char* path) {
    return luaL_loadfilex(L, path, "t");
}

#else

inline void* new_userdata(lua_State* L, std::size_t bytes) {
    return lua_newuserdata(L, bytes);
}
inline std::size_t raw_length(lua_State* L, int index) {
    return lua_objlen(L, index);
}
inline int absolute_index(lua_State* L, int index) {
    return index > 0 || index <= LUA_REGISTRYINDEX ? index : lua_gettop(L) + index + 1;
}
inline bool is_integer(lua_State*, int) {
    return false;
}
inline void push_integer(lua_State* L, long long value) {
    lua_pushnumber(L, static_cast<lua_Number>(value));
}
inline void raw_get_pointer(lua_State* L, int index, const void* key) {
    index = absolute_index(L, index);
    lua_pushlightuserdata(L, const_cast<void*>(key));
    lua_rawget(L, index);
}
inline void raw_set_pointer(lua_State* L, int index, const void* key) {
    index = absolute_index(L, index);
    lua_pushlightuserdata(L, const_cast<void*>(key));
    lua_insert(L, -2);
    lua_rawset(L, index);
}
inline int load_text_file(lua_State* L, const char* path) {
    return luaL_loadfilex(L, path, "t");
}

// Pushes a readable form of the value, as Lua 5.4's luaL_tolstring.
inline const char* to_display_string(lua_State* L, int index) {
    if (luaL_callmeta(L, index, "__tostring")) {
        if (lua_isstring(L, -1)) return lua_tostring(L, -1);
        lua_pop(L, 1);
    }
    switch (lua_type(L, index)) {
        case LUA_TNUMBER:
        case LUA_TSTRING:
            lua_pushvalue(L, index);
            break;
        case LUA_TBOOLEAN:
            lua_pushstring(L, lua_toboolean(L, index) ? "true" : "false");
            break;
        case LUA_TNIL:
            lua_pushliteral(L, "nil");
            break;
        default:
            lua_pushfstring(L, "%s: %p", luaL_typename(L, index), lua_topointer(L, index));
    }
    return lua_tostring(L, -1);
}

#endif

}  // namespace lissom::lua
