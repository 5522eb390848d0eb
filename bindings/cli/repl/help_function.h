/// The function `help` of prompts.
#pragma once

#include "bindings/lua/core/compat.h"

namespace lissom::cli {

/// Sets the global variable `help`: help() lists the topics, help(function), help(object) and
/// help(name) describe one. The state has the library open. May raise an error of Lua if there is
/// no memory.
void provide_help(lua_State* L);

}  // namespace lissom::cli
