#include "bindings/lua/core/state.h"

extern "C" int luaopen_lissom(lua_State* L) {
    static const lissom::lua::HostOptions kSilent;
    lissom::lua::open(L, kSilent);
    return 1;
}
