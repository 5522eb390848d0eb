/// How scripts move a camera as a hand does.
#pragma once

#include <vector>

#include "bindings/lua/core/registry.h"

namespace lissom::lua {

/// Methods of lissom.Camera.
std::vector<Function> navigation_methods();

}  // namespace lissom::lua
