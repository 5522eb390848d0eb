/// Whether a script looks at the later results of a call.
#pragma once

#include "bindings/lua/core/call_site.h"

namespace lissom::lua {

/// As drops_results, for the results after the first `kept`, 0 or 1: `local a = f()` drops all
/// after the first.
bool drops_results_after(int kept, lua_State* L, const CallCodes& codes);

}  // namespace lissom::lua
