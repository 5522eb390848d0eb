/// Values of a script as something to look at.
#pragma once

#include "bindings/lua/core/compat.h"
#include "viewer/render/picture.h"

namespace lissom::lua {

/// Returns the meshes, strands and scenes among the values at stack indices `first` to `last`, and
/// in tables there, each once; strands grow on the first of the meshes. Empty if there are none.
/// Raises no Lua error. Errors: those of drawing_of.
Picture picture_of_values(lua_State* L, int first, int last);

/// Returns whether there is nothing in `picture` to look at.
inline bool is_empty(const Picture& picture) {
    return picture.meshes.empty() && picture.strands.empty() && picture.marks.lines.empty() &&
           picture.marks.points.empty();
}

}  // namespace lissom::lua
