/// The Lua side of `lissom test`: framework.lua, as a text of the program.
#pragma once

#include <string_view>

namespace lissom::cli {

std::string_view test_framework();

}  // namespace lissom::cli
