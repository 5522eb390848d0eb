/// The Lua state of a script that lives in a window.
#pragma once

#include <filesystem>
#include <vector>

#include "bindings/lua/core/compat.h"

namespace lissom::window {

/// Lets os.exit raise an error: it would end the window and its contents.
void guard_exit(lua_State* L);

/// Returns the files of the modules that the state has loaded.
std::vector<std::filesystem::path> module_files(lua_State* L);

/// Provides the variables `lissom` and `help`, for lines of a console, if the script has none.
void provide_library(lua_State* L);

}  // namespace lissom::window
