/// strands:check; private to the binding.
#pragma once

#include "bindings/lua/core/registry.h"

namespace lissom::lua {

/// strand_check.cpp.
Function strand_check_method();

}  // namespace lissom::lua
