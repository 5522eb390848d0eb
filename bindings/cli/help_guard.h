/// Keeps a script from working if only its help was asked for.
#pragma once

#include "bindings/lua/core/compat.h"

namespace lissom::cli {

/// Lets nothing be printed, and ends the script at the first use of `io`, or of a function of `os`
/// with effects. May raise a Lua error.
void guard_for_help(lua_State* L);

}  // namespace lissom::cli
