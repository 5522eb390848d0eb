/// Tools of scripts: the parts of lissom.tool, lissom.tool_host and lissom.replay. The host itself
/// is written in Lua (host.lua and the files after it, see CMakeLists.txt), whose text is part of
/// the library.
#pragma once

#include <vector>

#include "bindings/lua/core/compat.h"
#include "bindings/lua/core/parameter.h"

namespace lissom::lua {

/// Pushes the table of functions of the host's Lua text; `tool_calls` describes those that C++
/// calls. Raises a Lua error if the state has no memory for it.
void push_tool_functions(lua_State* L);

/// Events of a hand that a host takes.
enum class EventKind { mouse, wheel, clock, key };

/// Returns the fields of an event, which hosts check and windows write.
const std::vector<Parameter>& event_fields(EventKind kind);

}  // namespace lissom::lua
