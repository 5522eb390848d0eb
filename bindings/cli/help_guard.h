/// Keeps a script from working where only its help was asked for.
#pragma once

#include "bindings/lua/core/compat.h"

namespace lissom::cli {

/// Lets nothing be printed, and the first use of `io`, or of what `os` can change, end the script.
/// May raise a Lua error.
void guard_for_help(lua_State* L);

}  // namespace lissom::cli
