/// Connection of scripts with a context; private to bindings/c. One of two sources defines it: that
/// of the folder script, or no_script.cpp if the library is built without Lua.
#pragma once

#include "bindings/c/context.h"

namespace lissom::c {

/// Gives a context its state for scripts; nothing without Lua.
void connect_scripts(lissom_context& context);

}  // namespace lissom::c
