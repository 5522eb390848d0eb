/// Sandbox: a Lua state for scripts that nobody vouches for. It has Lua's language, strings,
/// tables, numbers and coroutines, and the library; it has no operating system, no files but those
/// allowed, no binary chunks, and it ends when a limit is reached, whatever the script does to go
/// on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "bindings/lua/core/state.h"

namespace lissom::lua {

/// Limits of a script. The time and the instructions are those of one run.
struct SandboxLimits {
    /// Wall time; 0: as long as it takes.
    double seconds = 10.0;
    /// Instructions of Lua's virtual machine, counted in twenties; work of its libraries' functions
    /// counts as one per 64 bytes or table element. 0: any number.
    std::int64_t instructions = 0;
    /// Memory of Lua, and of the library for the script's objects and for its work, together.
    /// Finalizers of objects may go beyond it by some KB. 0: as much as there is.
    std::size_t memory_bytes = std::size_t{256} << 20;
    /// Printed bytes, and those of written files. A file is counted when it is there, so that the
    /// last one may go beyond; 0: any number.
    std::size_t output_bytes = std::size_t{64} << 20;
    /// Files below them may be read, or written. Without any, none may, but those of a host's table
    /// of files (ContextOptions::files), which then decides.
    std::vector<std::filesystem::path> read_folders, write_folders;
    /// Folders of `require` for NAME.lua, besides the library, and of lissom.load_tool for
    /// tools/NAME.lua.
    std::vector<std::filesystem::path> module_folders;
};

/// Reason for a script's end.
enum class SandboxEnd { none, seconds, instructions, output, cancelled };

class Sandbox {
  public:
    /// Opens the state. `print` gets the output of the script, with its line ends. Of `options` the
    /// memory limit and the check of files are replaced; the script's memory is charged to the
    /// account of its context too, if that is given.
    /// Errors: memory_limit if the state itself does not fit; invalid_argument for limits below
    /// zero.
    Sandbox(SandboxLimits limits, HostOptions options,
            std::function<void(std::string_view)> print = {});
    ~Sandbox();
    Sandbox(const Sandbox&) = delete;
    Sandbox& operator=(const Sandbox&) = delete;

    lua_State* lua() const;
    State& state() const { return *find_state(lua()); }
    /// Lets the script work in the context of the host, in place of one of its own that is made of
    /// the options: its cancel, its progress, its threads; within the limits as before.
    void work_in(const Context& context);
    /// The memory that Lua and the kernel have taken.
    std::shared_ptr<MemoryAccount> memory() const;

    /// Calls the function below `arguments` values on the stack as lua_pcall does, within the
    /// limits and with a handler of messages at stack index `handler` (0: none). The state is of
    /// use afterwards whatever has happened.
    int call(int arguments, int results, int handler = 0);
    /// Counts bytes that the host is about to show for the script, as a warning, from any thread.
    /// Returns false, and ends the script, if they are more than it may write; true while none
    /// runs.
    bool count_shown(std::size_t bytes);
    /// Returns why the last call was ended; none also if it failed by itself.
    SandboxEnd end() const;

    /// State for the code inside of it.
    struct Parts;
    Parts& parts() const { return *parts_; }

  private:
    void open_state();
    void close_state() noexcept;

    std::unique_ptr<Parts> parts_;
};

}  // namespace lissom::lua
