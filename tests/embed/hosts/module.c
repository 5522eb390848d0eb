/* A module of Lua, 5.1 or 5.4, that calls the library: call(name, arguments) returns its results as
 * text. */
#include <lauxlib.h>
#include <lua.h>

#include "bindings/c/lissom.h"

static int call(lua_State* L) {
    const char* name = luaL_checkstring(L, 1);
    const char* arguments = luaL_checkstring(L, 2);
    lissom_context* context = NULL;
    lissom_bytes json = {"", 0};
    if (lissom_context_create(NULL, &context) != LISSOM_OK) return luaL_error(L, "no context");
    if (lissom_call(context, name, arguments, &json) != LISSOM_OK) {
        lua_pushstring(L, lissom_last_error(context)->message);
        lissom_context_destroy(context);
        return lua_error(L);
    }
    lua_pushlstring(L, json.data, json.size);
    lissom_context_destroy(context);
    return 1;
}

int luaopen_lissom_caller(lua_State* L);
int luaopen_lissom_caller(lua_State* L) {
    lua_pushcfunction(L, call);
    return 1;
}
