// The debug library without the functions that let a script crash its host: they give out the
// library's own values, or change them.
#include "bindings/lua/sandbox/sandbox_state.h"

namespace lissom::lua {
namespace {

int refuse_debug(lua_State* L) {
    return luaL_error(L,
                      "debug.%s is out of a script's reach, as it can crash the host; `lissom run "
                      "--unsafe-debug` allows it",
                      lua_tostring(L, lua_upvalueindex(1)));
}

// Calls Lua's function, upvalue 1.
int call_debug(lua_State* L) {
    lua_pushvalue(L, lua_upvalueindex(1));
    lua_insert(L, 1);
    lua_call(L, lua_gettop(L) - 1, LUA_MULTRET);
    return lua_gettop(L);
}

// debug.getupvalue and debug.setupvalue: functions of C seem to have none.
int reach_upvalue(lua_State* L) {
    return lua_iscfunction(L, 1) ? 0 : call_debug(L);
}

// debug.getlocal and debug.setlocal: frames of C seem to have none.
int reach_local(lua_State* L) {
    lua_State* thread = lua_isthread(L, 1) ? lua_tothread(L, 1) : L;
    const int place = lua_isthread(L, 1) ? 2 : 1;
    if (lua_isfunction(L, place)) return call_debug(L);
    const lua_Integer level = luaL_checkinteger(L, place);
    lua_Debug frame;
    if (level < 0 || level > 1'000'000 || !lua_getstack(thread, static_cast<int>(level), &frame)) {
        return luaL_argerror(L, place, "level out of range");
    }
    lua_getinfo(thread, "S", &frame);
    if (*frame.what == 'C') return 0;
    if (thread == L) {
        // This function is a frame between the script and Lua's.
        lua_pushinteger(L, level + 1);
        lua_replace(L, place);
    }
    return call_debug(L);
}

// Metatables of the library's objects are shown as getmetatable shows them.
int show_metatable(lua_State* L) {
    const bool hides = lua_isuserdata(L, 1) && luaL_getmetafield(L, 1, "__metatable") != LUA_TNIL;
    return hides ? 1 : call_debug(L);
}

// Those of tables and of values without a metatable of the library may be set; a finalizer is for
// setmetatable, which lets it end.
int set_debug_metatable(lua_State* L) {
    const int type = lua_type(L, 1);
    const bool is_own = type == LUA_TUSERDATA || type == LUA_TSTRING || type == LUA_TTHREAD;
    const bool is_final = lua_istable(L, 2) && (lua_pushliteral(L, "__gc"), lua_rawget(L, 2));
    lua_settop(L, 2);
    if (!is_own && !is_final) return call_debug(L);
    return luaL_error(L,
                      "debug.setmetatable of a %s is out of a script's reach, as it can crash the "
                      "host; `lissom run --unsafe-debug` allows it",
                      is_final ? "finalizer" : luaL_typename(L, 1));
}

}  // namespace

void make_debug_safe(lua_State* L) {
    lua_getglobal(L, LUA_DBLIBNAME);
    for (const char* name : {"getregistry", "sethook"}) {
        lua_pushstring(L, name);
        lua_pushcclosure(L, refuse_debug, 1);
        lua_setfield(L, -2, name);
    }
    const luaL_Reg functions[] = {
        {"getupvalue", reach_upvalue},    {"setupvalue", reach_upvalue},
        {"getlocal", reach_local},        {"setlocal", reach_local},
        {"getmetatable", show_metatable}, {"setmetatable", set_debug_metatable}};
    for (const luaL_Reg& function : functions) {
        lua_getfield(L, -1, function.name);
        lua_pushcclosure(L, function.func, 1);
        lua_setfield(L, -2, function.name);
    }
    lua_pop(L, 1);
}

}  // namespace lissom::lua
