#include "bindings/lua/tools/tool_calls.h"

#include <cstddef>

#include "bindings/lua/tools/tools.h"

namespace lissom::lua {

std::span<const ToolCallRow> tool_calls() {
    using enum ToolCall;
    static const std::vector<ToolCallRow> kRows{
        {tool, "tool", false, {"tool"}, {"tool"}},
        {load_tool, "load_tool", false, {"name"}, {"tool"}},
        {host, "host", false, {"options"}, {"host"}},
        {replay, "replay", false, {"recording", "options"}, {"scene"}},
        {sketch, "sketch", false, {"style", "strokes", "options"}, {"curves"}},

        {open, "open", false, {"paths", "options"}, {"scene"}},
        {host_of, "host_of", false, {"..."}, {"host"}},
        {holds, "holds", false, {"host", "..."}, {"is_held"}},
        {save, "save", false, {"host", "path"}, {"left_out"}},
        {export_object,
         "export",
         false,
         {"host", "path", "meshes", "hair"},
         {"copy", "path", "object"}},
        {write_export, "write_export", false, {"host", "copy", "path", "object"}, {"told"}},

        {is_tool, "is_tool", false, {"value"}, {"is_tool"}},
        {use, "use", false, {"host", "word", "told"}, {}},
        {tool_files, "tool_files", false, {"word"}, {"files"}},
        {look, "look", false, {"host", "view"}, {}},
        {draw, "draw", false, {"host"}, {"camera", "is_z_up"}},
        {keep, "keep", false, {"host"}, {"text"}},
        {restore, "restore", false, {"host", "text", "selects"}, {}},

        {open_recording,
         "open_recording",
         false,
         {"path"},
         {"scene", "files", "playing", "times", "kinds"}},
        {play, "play", false, {"host", "playing", "place"}, {"difference", "differs", "tool"}},

        {press, "press", true, {"host", "event"}, {}},
        {move, "move", true, {"host", "event"}, {}},
        {release, "release", true, {"host", "event"}, {}},
        {wheel, "wheel", true, {"host", "event"}, {}},
        {tick, "tick", true, {"host", "event"}, {}},
        {key, "key", true, {"host", "event"}, {}},
        {cancel, "cancel", true, {"host"}, {}},
        {undo, "undo", true, {"host"}, {}},
        {redo, "redo", true, {"host"}, {}},

        {show, "show", true, {"host", "name", "visible"}, {}},
        {set, "set", true, {"host", "values"}, {}},
        {recover, "recover", true, {"host"}, {}},
        {begin_outside, "begin_outside", true, {"host"}, {}},
        {changed_outside, "changed_outside", true, {"host", "line", "failed"}, {"is_lost"}},
        {record, "record", true, {"host", "open", "options", "timed"}, {}},
        {recording, "recording", true, {"host"}, {"text"}},
        {keep_journal, "keep_journal", true, {"host", "open", "options"}, {}},
        {journal_text, "journal_text", true, {"host"}, {"text"}},
    };
    return kRows;
}

void push_tool_call(lua_State* L, ToolCall call) {
    const ToolCallRow& row = tool_calls()[static_cast<std::size_t>(call)];
    push_tool_functions(L);
    if (row.is_method) {
        lua_getfield(L, -1, "methods");
        lua_remove(L, -2);
    }
    lua_getfield(L, -1, row.name);
    lua_remove(L, -2);
}

}  // namespace lissom::lua
