/// The option `weld` of lissom.load and lissom.mesh.
#pragma once

#include "bindings/lua/core/call.h"
#include "bindings/lua/core/parameter.h"
#include "kernel/mesh/repair/repair.h"

namespace lissom::lua {

Parameter weld_option();

/// Returns the value of the option, if it was given. Raises a Lua error for true.
Weld given_weld(const Call& call);

}  // namespace lissom::lua
