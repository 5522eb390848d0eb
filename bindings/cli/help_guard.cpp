#include "bindings/cli/help_guard.h"

#include "bindings/lua/core/state.h"

namespace lissom::cli {
namespace {

int end_script(lua_State* L) {
    return lua::end_for_help(L, *lua::find_state(L));
}

int say_nothing(lua_State*) {
    return 0;
}

// Puts a table in the place of a library: it has `kept` of its functions, and all others end the
// script.
template <std::size_t Count>
void replace_library(lua_State* L, const char* name, const char* const (&kept)[Count]) {
    lua_getglobal(L, name);
    lua_newtable(L);
    for (const char* function : kept) {
        lua_getfield(L, -2, function);
        lua_setfield(L, -2, function);
    }
    lua_newtable(L);
    lua_pushcfunction(L, end_script);
    lua_setfield(L, -2, "__index");
    lua_setmetatable(L, -2);
    lua_getfield(L, LUA_REGISTRYINDEX, LUA_LOADED_TABLE);
    lua_pushvalue(L, -2);
    lua_setfield(L, -2, name);
    lua_pop(L, 1);
    lua_setglobal(L, name);
    lua_pop(L, 1);
}

}  // namespace

void guard_for_help(lua_State* L) {
    replace_library(L, "os", {"clock", "date", "difftime", "getenv", "time"});
    replace_library(L, "io", {"type"});
    lua_pushcfunction(L, say_nothing);
    lua_setglobal(L, "print");
}

}  // namespace lissom::cli
