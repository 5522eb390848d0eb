/// Values as a person at the prompt wants to see them.
#pragma once

#include <string>

#include "bindings/lua/core/compat.h"

namespace lissom::cli {

/// Returns the value at `index` as text: a string unchanged; a table with its fields, nested ones
/// as far as they fit, and `#` for a list that is too long; an object of lissom with its counts,
/// and its bounds if it has any. Runs no code of the script but __tostring, and never raises.
std::string display(lua_State* L, int index);

}  // namespace lissom::cli
