/// The option `weld` of lissom.load and lissom.mesh.
#pragma once

#include "bindings/lua/call.h"
#include "bindings/lua/parameter.h"
#include "kernel/mesh/repair.h"

namespace lissom::lua {

Parameter weld_option();

/// The value of the option, where it was given. Raises a Lua error for true.
Weld given_weld(const Call& call);

}  // namespace lissom::lua
