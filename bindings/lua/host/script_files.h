/// Files that scripts name and that are Lua or looked at, by the host's rules: its check_file is
/// asked first, and its table of files is where they are read.
#pragma once

#include <string_view>

#include "bindings/lua/core/compat.h"

namespace lissom::lua {

/// Returns a script without what may stand before its Lua text: a byte order mark, and a line for
/// the shell, whose end stays for the numbers of lines.
std::string_view lua_text_of(std::string_view bytes);

/// A C function for Lua: of a path and an environment (nil: the globals) the function of that file,
/// which is text, or nil and a message. A first line that begins with '#' is passed over.
int load_script_file(lua_State* L);

/// A C function for Lua: of a path true where there is such a file, else nil and why not.
int find_script_file(lua_State* L);

}  // namespace lissom::lua
