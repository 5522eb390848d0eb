/// A second wall around an untrusted script: the script runs in a child process that the system
/// keeps from files, network, programs and other processes; the parent ends it at its limits. A
/// script that takes the process over gains nothing. All code of the platform is in this folder;
/// Linux has the wall, on x86-64 and 64-bit ARM.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace lissom::cli {

/// Limits and rights of the child. They lie above those of lua::SandboxLimits, which are met first
/// unless a script outwits them.
struct WallRights {
    /// Wall time; 0 for any.
    double seconds = 0.0;
    /// Memory of the whole process; 0 for any.
    std::size_t memory_bytes = 0;
    /// Bytes written, to files or the standard output; 0 for any.
    std::size_t output_bytes = 0;
    int threads = 1;
    /// Folders that may be read, beside those of the system's libraries; and read and written.
    std::vector<std::filesystem::path> read_folders, write_folders;
};

/// Support of the system for the wall.
struct WallSupport {
    /// Version of Landlock, the system's rights of files; below 1 if it has none.
    int landlock = 0;
    /// Filters of system calls.
    bool filters = false;
};

WallSupport wall_support();

/// Returns whether the wall limits memory: not under a sanitizer, whose shadow is beyond any limit.
bool wall_limits_memory();

/// Returns the missing parts of the wall, as "Landlock (rights of files)"; empty if nothing.
std::string missing_wall(const WallSupport& support);

/// End of the child, as the parent tells it.
struct WallEnd {
    /// Exit status of the program: that of the child, 1 for a limit, 128 and the signal for a
    /// crash.
    int status = 0;
    /// "sandbox_time", "sandbox_memory", "sandbox_output", "sandbox_cpu" or "crash", with a
    /// message; empty if the child has ended by itself and told its errors.
    std::string code, message;
};

/// Forks. Returns nothing in the child, which is behind the wall from then on; in the parent it
/// returns when the child has ended. To be called by the only thread, before anything of the script
/// is read. Throws std::runtime_error if the system refuses.
std::optional<WallEnd> go_behind_wall(const WallRights& rights);

}  // namespace lissom::cli
