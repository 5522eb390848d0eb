#include "bindings/lua/host/counted_state.h"

#include <cstdlib>

#include "kernel/core/context.h"

namespace lissom::lua {
namespace {

bool charge(MemoryAccount& account, std::size_t bytes) {
    try {
        account.charge(bytes, "a script");
    } catch (...) {
        return false;
    }
    return true;
}

}  // namespace

void* allocate_counted(void* account, void* block, std::size_t old_size, std::size_t new_size) {
    auto& counted = *static_cast<MemoryAccount*>(account);
    if (!block) old_size = 0;
    if (new_size > old_size && !charge(counted, new_size - old_size)) return nullptr;
    if (new_size == 0) {
        std::free(block);
        counted.release(old_size);
        return nullptr;
    }
    void* moved = std::realloc(block, new_size);
    if (!moved) {
        // Lua relies on blocks that become smaller.
        if (new_size <= old_size) return block;
        counted.release(new_size - old_size);
        return nullptr;
    }
    if (new_size < old_size) counted.release(old_size - new_size);
    return moved;
}

int refuse_exit(lua_State* L) {
    return luaL_error(L,
                      "os.exit would end the program that runs this script; return from the "
                      "script, or raise an error");
}

void push_printed(lua_State* L) {
    const int count = lua_gettop(L);
    luaL_Buffer line;
    luaL_buffinit(L, &line);
    for (int i = 1; i <= count; ++i) {
        if (i > 1) luaL_addchar(&line, '\t');
        to_display_string(L, i);
        luaL_addvalue(&line);
    }
    luaL_pushresult(&line);
}

}  // namespace lissom::lua
