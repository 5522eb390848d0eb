/// Services that hosts of a Lua state share: counted memory, the output of print, and os.exit.
#pragma once

#include <cstddef>
#include <memory>

#include "bindings/lua/core/compat.h"

namespace lissom::lua {

/// A lua_Alloc that charges the lissom::MemoryAccount at `account`, and fails if that has no
/// room.
void* allocate_counted(void* account, void* block, std::size_t old_size, std::size_t new_size);

/// Closes a Lua state.
struct StateCloser {
    void operator()(lua_State* L) const { lua_close(L); }
};
/// A Lua state that is closed with its owner, also while an exception passes: a text of an error
/// may find no memory.
using OwnedState = std::unique_ptr<lua_State, StateCloser>;

/// os.exit of a script whose host goes on: raises an error with a replacement.
int refuse_exit(lua_State* L);

/// Pushes the values on the stack as print writes them, without a line end.
void push_printed(lua_State* L);

}  // namespace lissom::lua
