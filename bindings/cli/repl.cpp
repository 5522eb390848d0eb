// lissom repl
#include <CLI/CLI.hpp>
#include <cstring>
#include <iostream>

#include "bindings/cli/script.h"
#include "bindings/cli/terminal/line_editor.h"
#include "bindings/cli/verbs.h"

namespace lissom::cli {
namespace {

constexpr const char* kChunk = "=repl";

bool load(lua_State* L, const std::string& text) {
    return luaL_loadbufferx(L, text.data(), text.size(), kChunk, "t") == LUA_OK;
}

// Whether the message on top of the stack says that the chunk only lacks its end.
bool is_incomplete(lua_State* L) {
    std::size_t size = 0;
    const char* message = lua_tolstring(L, -1, &size);
    constexpr const char* kMark = "<eof>";
    const std::size_t mark = std::strlen(kMark);
    return message && size >= mark && std::strcmp(message + size - mark, kMark) == 0;
}

// Reads one chunk: an expression, or a statement over as many lines as it takes. Leaves the
// function or a message on the stack; false at the end of the input.
bool read_chunk(LineEditor& editor, lua_State* L, bool& loaded) {
    std::optional<std::string> line = editor.read("> ");
    if (!line) return false;
    std::string chunk = *line;
    if (load(L, "return " + chunk)) {
        editor.remember(chunk);
        loaded = true;
        return true;
    }
    lua_pop(L, 1);
    while (!(loaded = load(L, chunk)) && is_incomplete(L)) {
        line = editor.read(">> ");
        if (!line) break;
        lua_pop(L, 1);
        chunk += "\n" + *line;
    }
    editor.remember(chunk);
    return true;
}

// Prints all results, as `print` does.
ScriptResult print_results(Script& script) {
    lua_State* L = script.lua();
    const int count = lua_gettop(L);
    if (count == 0) return {};
    lua_getglobal(L, "print");
    lua_insert(L, 1);
    if (lua_pcall(L, count, 0, 0) == LUA_OK) return {};
    ScriptResult result;
    result.status = kFailure;
    const char* text = lua_tostring(L, -1);
    result.message = text ? text : "the results cannot be printed";
    return result;
}

ScriptResult run_chunk(Script& script, bool loaded) {
    lua_State* L = script.lua();
    if (!loaded) {
        ScriptResult result;
        result.status = kFailure;
        result.message = lua_tostring(L, -1);
        return result;
    }
    const ScriptResult result = script.call_function();
    return result.status == kSuccess ? print_results(script) : result;
}

}  // namespace

int repl(Program& program, const std::vector<std::string>& words) {
    CLI::App app(
        "Reads Lua from the keyboard and runs it line by line. The module is in the global "
        "variable `lissom`.",
        "lissom repl");
    int status = kSuccess;
    if (!program.parse(app, words, status)) return status;
    if (program.json()) program.output = Output::json_errors;
    Script script(program, {});
    lua_State* L = script.lua();
    lua::open(L, {});
    lua_setglobal(L, "lissom");
    LineEditor editor;
    if (editor.interactive()) std::cout << "lissom " LISSOM_VERSION ", " LUA_RELEASE "\n";
    bool loaded = false;
    while (read_chunk(editor, L, loaded)) {
        const ScriptResult result = run_chunk(script, loaded);
        if (result.status != kSuccess) {
            program.fail(result.message);
            if (!editor.interactive()) status = kFailure;
        }
        if (program.interrupted()) program.forget_interrupt();
        lua_settop(L, 0);
        std::cout << std::flush;
    }
    if (editor.interactive()) std::cout << "\n";
    return status;
}

}  // namespace lissom::cli
