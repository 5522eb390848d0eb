/* A host with a Lua of its own, 5.1 or 5.4, which it exports or shares: scripts of the host, calls
   and scripts of the library, and scripts of the host again. With the word `first` the library is
   used before the host's own state. */
#include <lauxlib.h>
#include <lua.h>
#include <lualib.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bindings/c/lissom.h"

static void require_that(int holds, const char* what) {
    if (holds) return;
    fprintf(stderr, "not so: %s\n", what);
    exit(1);
}

static void run_own(lua_State* L, const char* script, double expected) {
    require_that(luaL_loadstring(L, script) == 0 && lua_pcall(L, 0, 1, 0) == 0, script);
    require_that(lua_tonumber(L, -1) == expected, script);
    lua_pop(L, 1);
}

static lua_State* open_own(void) {
    lua_State* L = luaL_newstate();
    require_that(L != NULL, "a state of the host");
    luaL_openlibs(L);
    run_own(L, "kept = 42 return kept", 42);
    return L;
}

static void use_library(void) {
    static const char kScript[] =
        "local text = {} for i = 1, 100 do text[i] = ('%d'):format(i // 1 & 127) end "
        "return #table.concat(text), pcall(error, 'no')";
    lissom_context* context = NULL;
    lissom_script script;
    lissom_bytes json;
    require_that(lissom_context_create(NULL, &context) == LISSOM_OK, "a context");
    require_that(lissom_call(context, "shapes.box", "[]", &json) == LISSOM_OK, "a call");
    require_that(strstr(json.data, "lissom.Mesh") != NULL, json.data);
    require_that(lissom_call(context, "shapes.boxx", "[]", &json) == LISSOM_OUT_OF_RANGE,
                 "an error");
    require_that(lissom_script_load(context, kScript, sizeof kScript - 1, "script.lua", &script) ==
                     LISSOM_OK,
                 "a script");
    require_that(lissom_script_run(context, script, NULL, &json) == LISSOM_OK, "its run");
    require_that(strcmp(json.data, "[192,false,\"no\"]") == 0, json.data);
    lissom_context_destroy(context);
}

int main(int count, char** words) {
    const int library_first = count > 1 && strcmp(words[1], "first") == 0;
    lua_State* L = NULL;
    if (library_first) use_library();
    L = open_own();
    use_library();
    run_own(L, "local t = {} for i = 1, 1000 do t[i] = {i} end return kept + #t", 1042);
    lua_close(L);
    puts("both work");
    return 0;
}
