/// script_place: the position in a script, for messages.
#pragma once

struct lua_State;

namespace lissom::cli {

/// Pushes "file:line: " of the first line of a script on the stack, from this level on, or "" if
/// there is none. The library's own Lua is no script.
void push_script_place(lua_State* L, int level);

}  // namespace lissom::cli
