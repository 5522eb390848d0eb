/// The `lissom` program: verbs, and their shared services. Another library adds its own verbs and
/// Lua functions by its parts:
///
///     int main(int argc, char** argv) {
///         lissom::cli::ProgramParts parts = lissom::cli::kernel_parts();
///         parts.libraries.push_back(viewer_library);
///         parts.verbs.push_back({"render", "MESH... -o FILE", "Draws a picture.", run_render});
///         return lissom::cli::run_program(argc, argv, parts);
///     }
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bindings/cli/test/picture_check.h"
#include "bindings/lua/core/state.h"
#include "kernel/core/context.h"
#include "kernel/core/error.h"

namespace CLI {
class App;
}

namespace lissom::cli {

class Program;

/// Exit statuses; the last as shells report a program ended by a signal.
inline constexpr int kSuccess = 0, kFailure = 1, kUsage = 2, kInterrupted = 130;

/// One thing that the program can do.
struct Verb {
    std::string name;
    /// Words after the name: "FILE [--name value ...]".
    std::string usage;
    std::string summary;
    /// Runs it with the words that follow the name; returns the exit status.
    int (*run)(Program& program, const std::vector<std::string>& words);
};

/// Parts of a program.
struct ProgramParts {
    std::vector<Verb> verbs;
    /// Make the libraries that scripts see; asked only when a verb runs Lua.
    std::vector<lua::Library (*)()> libraries;
    /// Lines of --version after the first.
    std::vector<std::string> version_lines;
    /// Compares the pictures of tests; null in a program that draws none.
    ComparePictures compare_pictures = nullptr;
};

/// Returns the verbs run, test, inspect, convert, repl and explain, and the kernel's library.
ProgramParts kernel_parts();

/// Runs the verb that the command line names. Returns the exit status: that of the verb,
/// kInterrupted if Ctrl-C stopped it, kFailure if the standard output could not be written.
int run_program(int argc, char** argv, const ProgramParts& parts);

/// Runs the verb that the first word names with the words behind it, and writes its error if it
/// has one. Returns its exit status.
int run_verb(Program& program, const std::vector<std::string>& words);

/// Form of a verb's answer and its errors.
enum class Output {
    /// For people: the answer to the standard output, errors to the standard error.
    text,
    /// Both as one JSON object to the standard output.
    json,
    /// Errors as one line of JSON to the standard error: the standard output belongs to a script.
    json_errors,
};

/// Services shared by verbs: common options, their context, and reports.
class Program {
  public:
    explicit Program(const ProgramParts& parts);
    ~Program();

    const ProgramParts& parts() const { return parts_; }

    /// Parses the words of a verb with the options of `app` and the common
    /// ones: --json, --threads, --debug, --help. Returns true if the verb shall
    /// go on; otherwise `status` holds the exit status and all output was
    /// printed.
    bool parse(CLI::App& app, const std::vector<std::string>& words, int& status);

    Output output = Output::text;
    /// Receives the text of --help; null for the standard output.
    std::ostream* help_stream = nullptr;
    bool debug = false;
    /// Scripts have functions of Lua's debug library that can crash the program.
    bool unsafe_debug = false;
    /// Receives each message of the log first, if it is set; false keeps the message from the
    /// standard error.
    std::function<bool(LogLevel, std::string_view)> log_filter;
    /// Receives progress instead of the terminal, if it is set.
    std::function<void(std::string_view label, double fraction)> progress_listener;
    /// Receives answers in the form of JSON, and errors, instead of the standard output, if it is
    /// set.
    std::function<void(const std::string& json)> answer_listener;
    /// Hears of each file that a script opens by the library, if it is set.
    std::function<void(const std::filesystem::path& file, lua::FileUse use)> file_used;
    /// Threads of the kernel's loops; 0 for as many as there are cores.
    int threads = 0;

    bool json() const { return output != Output::text; }

    /// Returns the context of the verb: its threads, a progress bar on a terminal, warnings to the
    /// standard error, cancelled by Ctrl-C.
    const Context& context();
    /// Returns the same for a Lua state, which has a context of its own.
    lua::HostOptions host_options();
    /// Ctrl-C cancels this context from now on; it must not move.
    void listen(const Context& context);
    /// Returns whether Ctrl-C was pressed since.
    bool interrupted() const;
    /// Goes on as if it had not been pressed.
    void forget_interrupt();
    /// While a line is typed Ctrl-C only gives it up, however often it is pressed.
    static void wait_at_prompt(bool waits);
    /// Shows on a terminal the fraction done of the verb's own work, 0 to 1.
    void show_progress(std::string_view label, double fraction);
    /// Takes the progress bar away; before anything is written.
    void clear_progress();

    /// Writes the answer of a verb as JSON, a line of text.
    void answer(const std::string& json) const;
    /// Writes an error, with ids from 1, and returns kFailure.
    int fail(const Error& error);
    /// Writes a message of a kind that has no code and returns `status`.
    int fail(const std::string& message, int status = kFailure);

  private:
    struct Parts;

    ContextOptions context_options();

    const ProgramParts& parts_;
    std::unique_ptr<Parts> own_;
};

}  // namespace lissom::cli
