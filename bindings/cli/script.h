/// A Lua state as the program opens it: Lua's libraries, lissom, Ctrl-C, and errors as people want
/// to read them.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings/cli/program.h"
#include "bindings/lua/sandbox/sandbox.h"
#include "bindings/lua/sandbox/stoppable.h"

namespace lissom::cli {

/// A line of a script that was being run.
struct ScriptLine {
    /// Name of the script; as messages show it, a long one cut short.
    std::string file, shown;
    int line = 0;
};

/// Result of a script.
struct ScriptResult {
    int status = kSuccess;
    /// Error message: "file:line: message", then notes; a traceback below it under --debug.
    std::string message;
    /// Code of the error object, or that in brackets at the end of the message.
    std::string code;
    /// Place of the error, if known.
    std::string file;
    int line = 0;
    /// Calls at the failure: the innermost line first, then its callers.
    std::vector<ScriptLine> calls;
};

class Script {
  public:
    /// `arguments.script` is empty for a state that runs no script. With limits it runs in a
    /// sandbox, whose modules are those beside the script and those installed with the program.
    Script(Program& program, lua::ScriptArguments arguments,
           const std::optional<lua::SandboxLimits>& limits = {});
    ~Script();
    Script(const Script&) = delete;
    Script& operator=(const Script&) = delete;

    lua_State* lua() const { return L_; }
    lua::State& state() const { return *lua::find_state(L_); }

    /// Runs the file `path`; --help and wrong flags of its parameters end it early.
    ScriptResult run_file(const std::string& path);
    /// Runs a text that came from the standard input.
    ScriptResult run_text(std::string text);

    /// Calls the function on top of the stack, whose results stay there.
    ScriptResult call_function();

    /// Returns the files of the modules that the script has loaded.
    std::vector<std::string> module_files();

    /// Returns the folder of the Lua library installed with the program; empty if it is not found.
    static std::string shipped_scripts();

  private:
    void open_trusted();
    void open_in_sandbox(const lua::SandboxLimits& limits);
    int call_protected(int handler);
    ScriptResult run_loaded(int status);
    ScriptResult failure();

    Program& program_;
    lua::HostOptions options_;
    // Null for a script that is trusted.
    std::unique_ptr<lua::Sandbox> sandbox_;
    lua::Stoppable stoppable_;
    lua_State* L_ = nullptr;
};

}  // namespace lissom::cli
