// A host with a Lua of its own opens the binding in it, and runs a script in a sandbox.
#include <lissom/lua/core/state.h>
#include <lissom/lua/sandbox/sandbox.h>

#include <cstdio>

int main() {
    lua_State* L = luaL_newstate();
    luaL_openlibs(L);
    luaL_requiref(L, "lissom", luaopen_lissom, 0);
    lua_pop(L, 1);
    const bool failed = luaL_dostring(L, "assert(#require('lissom').shapes.box() == 8)");
    if (failed) std::puts(lua_tostring(L, -1));
    lua_close(L);

    lissom::lua::SandboxLimits limits;
    limits.seconds = 0.1;
    lissom::lua::Sandbox sandbox(limits, {});
    luaL_loadstring(sandbox.lua(), "while true do end");
    const bool ended = sandbox.call(0, 0) != LUA_OK;
    return !failed && ended && sandbox.end() == lissom::lua::SandboxEnd::seconds ? 0 : 1;
}
