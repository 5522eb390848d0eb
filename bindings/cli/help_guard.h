/// Ends a script early if only its help was asked for.
#pragma once

#include "bindings/lua/core/compat.h"

namespace lissom::cli {

/// Suppresses printing; the first use of `io`, or of a function of `os` with effects, ends the
/// script. May raise a Lua error.
void guard_for_help(lua_State* L);

}  // namespace lissom::cli
