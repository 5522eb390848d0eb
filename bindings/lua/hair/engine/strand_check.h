/// strands:check and strands:follow; private to the binding.
#pragma once

#include <vector>

#include "bindings/lua/core/registry.h"

namespace lissom::lua {

/// strand_check.cpp.
Function strand_check_method();
/// strand_follow.cpp: follow, follower.
std::vector<Function> strand_follow_methods();

}  // namespace lissom::lua
