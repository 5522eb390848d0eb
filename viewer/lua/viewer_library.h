/// The viewer's part of Lua: pictures, described in the same registration table as the kernel's own
/// functions (bindings/lua/core/registry.h).
#pragma once

#include <functional>
#include "bindings/lua/core/compat.h"
#include "bindings/lua/core/registry.h"
#include "viewer/render/picture.h"

namespace lissom::lua {

Library viewer_library();

/// Receives the picture of each lissom.render before it is drawn; on the thread of the script.
using PictureListener = std::function<void(const Picture&)>;
/// `listener` sees the pictures of `L` from now on, and must outlive it; null: nobody does.
void set_picture_listener(lua_State* L, const PictureListener* listener);

/// Returns its parts; private to viewer.
std::vector<Function> render_functions();
std::vector<Function> bake_functions();

}  // namespace lissom::lua
