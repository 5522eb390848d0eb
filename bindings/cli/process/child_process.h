/// Other processes of this program, and their messages. All code of the platform that `lissom test`
/// needs is in child_process.cpp, for systems with POSIX.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace lissom::cli {

/// End of a process.
struct ProcessEnd {
    /// Exit status of the process; the number of the signal that ended it, if there was one.
    int status = 0;
    bool by_signal = false;
    /// Seconds of processors that it used, with its ended children.
    double cpu_seconds = 0.0;
    /// Greatest memory, in bytes.
    std::uint64_t memory = 0;

    /// Returns "status 3", "signal 11 (Segmentation fault)".
    std::string text() const;
};

/// This program, started again. It reads nothing, and writes to a file; its messages are lines
/// of a channel of their own (see ParentProcess). Destroying this object kills it and its
/// children.
class ChildProcess {
  public:
    /// Starts the program with `words` as its command line. Both its outputs go to the end of the
    /// file `output`. The descriptors `held`, of 10 or more, stay open in the process and in all
    /// that it starts. Throws std::runtime_error if the system refuses.
    ChildProcess(const std::vector<std::string>& words, const std::filesystem::path& output,
                 const std::vector<int>& held = {});
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Returns its messages since the last call, without waiting.
    std::vector<std::string> lines();
    /// Returns whether it has ended and all its messages were taken.
    bool has_ended() const;
    /// Returns the end of a process that has ended.
    const ProcessEnd& end() const;
    /// Kills it and its children at once.
    void kill();

    /// Waits until one of the processes tells something or ends, or the time is over.
    static void wait(const std::vector<const ChildProcess*>& processes, double seconds);

  private:
    struct Parts;

    std::unique_ptr<Parts> own_;
};

/// The process that started this one by ChildProcess; at most one object in a process. If it dies,
/// this process is ended if the system can do so.
class ParentProcess {
  public:
    ParentProcess();

    /// Sends it a line; returns false if nobody listens.
    bool tell(const std::string& line) const;
};

/// Resources that a process and its ended children have used.
struct ProcessUse {
    double cpu_seconds = 0.0;
    /// Greatest memory, in bytes.
    std::uint64_t memory = 0;
};
ProcessUse process_use();

/// Sends both outputs of this process to the end of a file from now on. Throws std::runtime_error
/// if the file cannot be opened.
void redirect_outputs(const std::filesystem::path& file);

/// Interrupts this program as Ctrl-C does.
void interrupt_program();

/// Returns the file of this program; empty if the system does not tell.
std::filesystem::path program_file();

}  // namespace lissom::cli
