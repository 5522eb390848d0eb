/// Where scripts connect with a context; private to bindings/c. One of two sources defines it: that
/// of the folder script, or no_script.cpp where the library is built without Lua.
#pragma once

#include "bindings/c/context.h"

namespace lissom::c {

/// Gives a context what scripts need; nothing without Lua.
void connect_scripts(lissom_context& context);

}  // namespace lissom::c
