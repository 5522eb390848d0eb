/// Values as a person at the prompt wants to see them.
#pragma once

#include <string>

#include "bindings/lua/core/compat.h"

namespace lissom::cli {

/// The value at `index`: a string as it is; a table with its fields, those of tables in it as far
/// as they fit, and `#` where a list is too long; an object of lissom with its counts, and its
/// bounds where it has any. Runs no code of the script but __tostring, and never raises.
std::string display(lua_State* L, int index);

}  // namespace lissom::cli
