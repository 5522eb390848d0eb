/// Lua files and other files that scripts name, by the host's rules: its check_file is asked first,
/// and they are read from its table of files.
#pragma once

#include <string_view>

#include "bindings/lua/core/compat.h"

namespace lissom::lua {

/// Returns a script without the prefix of its Lua text: a byte order mark, and a line for the
/// shell, whose end stays for the numbers of lines.
std::string_view lua_text_of(std::string_view bytes);

/// A C function for Lua: of a path and an environment (nil: the globals) the function of that file,
/// which is text, or nil and a message. A first line that begins with '#' is passed over.
int load_script_file(lua_State* L);

/// A C function for Lua: for a path, returns true if there is such a file, else nil and the reason.
int find_script_file(lua_State* L);

}  // namespace lissom::lua
