/// Tools of scripts: the parts of lissom.tool, lissom.tool_host and lissom.replay. The host itself
/// is written in Lua (host.lua and the files after it, see CMakeLists.txt), whose text is part of
/// the library.
#pragma once

#include <vector>

#include "bindings/lua/core/compat.h"
#include "bindings/lua/core/parameter.h"

namespace lissom::lua {

/// Pushes a function of the host's Lua text: "tool", "host", "replay", "open" (of paths and the
/// options of lissom.load: their scene), "load_tool", or one that windows call (windows.lua).
/// Raises a Lua error if the state has no memory for it.
void push_tool_function(lua_State* L, const char* name);

/// Events of a hand that a host takes.
enum class EventKind { mouse, wheel, key };

/// Returns the fields of an event, which hosts check and windows write.
const std::vector<Parameter>& event_fields(EventKind kind);

}  // namespace lissom::lua
