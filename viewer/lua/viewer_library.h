/// What the viewer adds to Lua: pictures, described in the same registration table as
/// the kernel's own functions (bindings/lua/core/registry.h).
#pragma once

#include "bindings/lua/core/registry.h"

namespace lissom::lua {

Library viewer_library();

/// Its parts; private to viewer.
std::vector<Function> render_functions();

}  // namespace lissom::lua
