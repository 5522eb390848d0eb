// lissom repl
#include <CLI/CLI.hpp>
#include <cstring>
#include <iostream>

#include "bindings/cli/repl/completion.h"
#include "bindings/cli/repl/display.h"
#include "bindings/cli/repl/help_function.h"
#include "bindings/cli/repl/session_text.h"
#include "bindings/cli/script.h"
#include "bindings/cli/script_text.h"
#include "bindings/cli/terminal/line_editor.h"
#include "bindings/cli/verbs.h"
#include "kernel/core/version.h"

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

// ---- Reading

// Typed input: a chunk on the stack, a message there, a line given up, or the end of the input.
enum class Typed { chunk, mistake, nothing, end };

class Prompt {
  public:
    Prompt(Program& program, lua_State* L)
        : L_(L),
          editor_({[this](const std::string& line) { return completed(line); },
                   [&program] { return program.interrupted(); }, history_file()}) {}

    bool interactive() const { return editor_.interactive(); }

    // An expression, or a statement over as many lines as it takes.
    Typed read() {
        before_.clear();
        LineEditor::Read typed = editor_.read("> ");
        if (typed.outcome == LineEditor::Outcome::end) return Typed::end;
        if (typed.outcome == LineEditor::Outcome::interrupted) return Typed::nothing;
        // Input from a file may begin with a byte order mark.
        std::string chunk(without_mark(typed.line));
        if (load(L_, "return " + chunk)) {
            editor_.remember(chunk);
            return Typed::chunk;
        }
        lua_pop(L_, 1);
        bool loaded;
        while (!(loaded = load(L_, chunk)) && is_incomplete(L_)) {
            before_ = chunk + "\n";
            typed = editor_.read(">> ");
            if (typed.outcome == LineEditor::Outcome::interrupted) return Typed::nothing;
            if (typed.outcome == LineEditor::Outcome::end) break;
            lua_pop(L_, 1);
            chunk += "\n" + typed.line;
        }
        editor_.remember(chunk);
        if (loaded) keep_locals(chunk);
        return loaded ? Typed::chunk : Typed::mistake;
    }

  private:
    // Replaces the chunk on the stack by one whose outermost locals the next lines find.
    void keep_locals(const std::string& chunk) {
        const std::string kept = with_session_variables(chunk);
        if (kept == chunk) return;
        lua_remove(L_, load(L_, kept) ? -2 : -1);
    }

    Completions completed(const std::string& line) {
        Completions found = completions(L_, before_ + line);
        found.begin -= std::min(found.begin, before_.size());
        return found;
    }

    lua_State* L_;
    // Lines of the chunk above the one that is typed.
    std::string before_;
    LineEditor editor_;
};

// ---- Running

// Shows results on one line as `print` writes them, or below each other if one takes several.
void show_results(lua_State* L) {
    const int count = lua_gettop(L);
    std::string text;
    bool several_lines = false;
    for (int i = 1; i <= count; ++i) {
        const std::string one = display(L, i);
        several_lines = several_lines || one.find('\n') != std::string::npos;
        text += (i > 1 ? "\t" : "") + one;
    }
    if (several_lines) {
        text.clear();
        for (int i = 1; i <= count; ++i) text += (i > 1 ? "\n" : "") + display(L, i);
    }
    if (count > 0) std::cout << text << "\n";
}

ScriptResult run_chunk(Script& script, Typed typed) {
    lua_State* L = script.lua();
    if (typed == Typed::mistake) {
        ScriptResult result;
        result.status = kFailure;
        result.message = lua_tostring(L, -1);
        return result;
    }
    ScriptResult result = script.call_function();
    if (result.status == kSuccess) show_results(L);
    return result;
}

int evaluate_lines(Program& program, Script& script) {
    int status = kSuccess;
    Prompt prompt(program, script.lua());
    if (prompt.interactive()) {
        std::cout << "lissom " LISSOM_VERSION ", " LUA_RELEASE
                     "; help() lists everything, Ctrl-C gives up a line or stops the running "
                     "call, Ctrl-D ends\n";
    }
    while (true) {
        program.wait_at_prompt(true);
        const Typed typed = prompt.read();
        program.wait_at_prompt(false);
        program.forget_interrupt();
        if (typed == Typed::end) break;
        if (typed != Typed::nothing) {
            const ScriptResult result = run_chunk(script, typed);
            if (result.status != kSuccess) program.fail(result.message);
            if (result.status != kSuccess && !prompt.interactive()) status = kFailure;
        }
        if (program.interrupted()) program.forget_interrupt();
        lua_settop(script.lua(), 0);
        std::cout << std::flush;
    }
    if (prompt.interactive()) std::cout << "\n";
    return status;
}

}  // namespace

int repl(Program& program, const std::vector<std::string>& words) {
    CLI::App app(
        "Reads Lua from the keyboard and runs it line by line. The module is in the global "
        "variable `lissom`; help() lists its functions.",
        "lissom repl");
    int status = kSuccess;
    if (!program.parse(app, words, status)) return status;
    if (program.json()) program.output = Output::json_errors;
    Script script(program, {});
    lua_State* L = script.lua();
    lua::open(L, {});
    lua_setglobal(L, "lissom");
    provide_help(L);
    return evaluate_lines(program, script);
}

}  // namespace lissom::cli
