/// Values of a script as something to look at.
#pragma once

#include "bindings/lua/core/compat.h"
#include "viewer/picture.h"

namespace lissom::lua {

/// The meshes and strands among the values at stack indices `first` to `last`, and in tables there,
/// each once; strands grow on the first of the meshes. Empty where there are none. Raises no Lua
/// error; may throw std::bad_alloc.
Picture picture_of_values(lua_State* L, int first, int last);

}  // namespace lissom::lua
