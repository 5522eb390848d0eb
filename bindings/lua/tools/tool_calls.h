/// The calls from C++ to the host of tools, which is written in Lua.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "bindings/lua/core/compat.h"

namespace lissom::lua {

/// A function of the host's Lua text, or a method of a host.
enum class ToolCall {
    // Tools, hosts and recordings: the functions of scripts.
    tool,
    load_tool,
    host,
    replay,
    sketch,
    // Scenes of windows.
    open,
    host_of,
    holds,
    save,
    export_object,
    write_export,
    // The tool in hand.
    is_tool,
    use,
    tool_files,
    look,
    draw,
    keep,
    restore,
    // Recordings that are played.
    open_recording,
    play,
    // Methods of a host: inputs of a hand.
    press,
    move,
    release,
    wheel,
    tick,
    key,
    cancel,
    undo,
    redo,
    // Others.
    show,
    set,
    recover,
    begin_outside,
    changed_outside,
    record,
    recording,
    keep_journal,
    journal_text,
};

/// Description of a call.
struct ToolCallRow {
    ToolCall call;
    /// The function's name in the Lua text.
    const char* name;
    /// Whether it is a method: its first argument is the host.
    bool is_method;
    /// Names of the arguments; "..." for any number. Later ones may be left out.
    std::vector<std::string_view> arguments;
    /// Names of the results.
    std::vector<std::string_view> results;
};

/// Returns the descriptions of all calls, in the order of the enumerators.
std::span<const ToolCallRow> tool_calls();

/// Pushes the function of a call. Raises a Lua error if the state has no memory for it.
void push_tool_call(lua_State* L, ToolCall call);

}  // namespace lissom::lua
