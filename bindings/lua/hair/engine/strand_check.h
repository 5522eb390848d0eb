/// strands:check, strands:follow, strands:shell; private to the binding.
#pragma once

#include <vector>

#include "bindings/lua/core/registry.h"

namespace lissom::lua {

/// strand_check.cpp.
Function strand_check_method();
/// strand_follow.cpp: follow, follower, transfer.
std::vector<Function> strand_follow_methods();
/// levels.cpp: shell, silhouette_error.
std::vector<Function> strand_level_methods();

}  // namespace lissom::lua
