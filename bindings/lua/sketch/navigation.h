/// Moves of a camera by drags and wheel, for scripts.
#pragma once

#include <vector>

#include "bindings/lua/core/registry.h"

namespace lissom::lua {

/// Methods of lissom.Camera.
std::vector<Function> navigation_methods();

}  // namespace lissom::lua
