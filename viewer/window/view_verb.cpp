#include "viewer/window/view_verb.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "bindings/cli/load_flags.h"
#include "kernel/core/index.h"
#include "viewer/window/session/session.h"
#include "viewer/window/view_app.h"
#include "viewer/window/view_arguments.h"

namespace lissom::cli {
namespace {

std::string check_size(const std::string& text) {
    int width = 0, height = 0, used = 0;
    const bool read = std::sscanf(text.c_str(), "%dx%d%n", &width, &height, &used) == 2;
    const bool good = read && used == count_of(text) && width > 0 && height > 0;
    return good ? "" : "a size is written as 1280x800";
}

// The options of the command line, as they are written.
struct ViewCommand {
    window::ViewOptions options;
    std::vector<std::string> files;
    std::string size = "1280x800", up;
    LoadFlags flags;

    bool plays() const { return files.size() == 1 && window::is_recording(files.front()); }
};

// Returns the option of the speed.
CLI::Option* declare(CLI::App& app, ViewCommand& command) {
    window::ViewOptions& options = command.options;
    app.add_option("FILE", command.files, "Mesh files, one script, or one recording");
    app.add_option("--size", command.size, "Width and height of the window (default: 1280x800)")
        ->check(check_size);
    app.add_option(
           "--tool", options.tools,
           "The tool in hand: a file, or the name of one that ships; others may follow with "
           "a --tool each, which get a button, as do the files of lissom/tools in "
           "$XDG_DATA_HOME or ~/.local/share")
        ->allow_extra_args(false)
        ->type_name("TEXT");
    app.add_option("--record", options.session.record,
                   "Record the work of tools in this file, a script that repeats it");
    app.add_option("--journal", options.session.journal,
                   "Write the calls that tools make to this file, a script to read and change");
    CLI::Option* speed =
        app.add_option("--speed", options.speed,
                       "Speed of a recording, 0.02 to 60 times its own (default: 1)")
            ->check(CLI::Range(0.02, 60.0));
    app.add_option("--up", command.up, "Up axis of the mesh files")
        ->check(CLI::IsMember({"y", "z"}));
    app.add_option("--unit", options.session.load.unit,
                   "Length of the mesh files' unit: coordinates are multiplied by it (default: 1)")
        ->check(CLI::PositiveNumber);
    command.flags.declare(app);
    app.add_flag("--tell", options.tells, "Report events of the window, for tests");
    return speed;
}

// The file among those that are shown which would be written, or "".
std::string overwritten_file(const ViewCommand& command) {
    const window::SessionOptions& session = command.options.session;
    std::error_code error;
    for (const std::string& file : command.files) {
        for (const std::string& written : {session.record, session.journal}) {
            if (std::filesystem::equivalent(file, written, error)) return written;
        }
    }
    return "";
}

// Returns the first fault of words that were read, or "".
std::string fault_of(const ViewCommand& command, bool has_speed) {
    if (command.files.size() > 1 && window::is_script(command.files.back())) {
        return "give either meshes or one script";
    }
    if (has_speed && !command.plays()) return "--speed is for a recording";
    if (command.plays() && !command.options.tools.empty()) {
        return "a recording brings its own tools: leave out --tool";
    }
    const std::string written = overwritten_file(command);
    return written.empty() ? "" : written + " is opened, and would be overwritten";
}

window::ViewOptions view_options(const ViewCommand& command) {
    window::ViewOptions options = command.options;
    std::sscanf(command.size.c_str(), "%dx%d", &options.width, &options.height);
    if (!options.tools.empty()) options.session.tool = options.tools.front();
    command.flags.apply(options.session.load);
    if (!command.up.empty()) options.session.load.up = command.up == "y" ? UpAxis::y : UpAxis::z;
    options.words.insert(options.words.begin(), command.files.begin(), command.files.end());
    return options;
}

}  // namespace

int view(Program& program, const std::vector<std::string>& words) {
    const window::ViewArguments split = window::split_arguments(words);
    ViewCommand command;
    command.options.words = split.scripts;
    CLI::App app(
        "Shows meshes, or the drawn or returned objects of a script, in a window. Words after a "
        "script are the script's, but for --tool, --record and --journal before a \"--\"; its "
        "parameters become sliders, and it runs again when its file changes. A file written by "
        "--record is played.",
        "lissom view");
    const CLI::Option* speed = declare(app, command);
    int status = kSuccess;
    if (!program.parse(app, split.own, status)) return status;
    const std::string fault = fault_of(command, speed->count() > 0);
    if (!fault.empty()) return program.fail("lissom view: " + fault, kUsage);
    return window::run_view(program, view_options(command));
}

}  // namespace lissom::cli
