/// What the viewer adds to Lua: cameras and pictures, described in the same registration table as
/// the kernel's own functions (bindings/lua/core/registry.h).
#pragma once

#include "bindings/lua/core/registry.h"

namespace lissom::lua {

Library viewer_library();

/// Its parts; private to viewer.
Type camera_type();
std::vector<Function> camera_functions();
std::vector<Function> render_functions();

/// Options of a standard view: view, up, parallel, margin.
std::vector<Parameter> view_options();
/// The option that SizeRequest reads.
Parameter size_argument();

}  // namespace lissom::lua
