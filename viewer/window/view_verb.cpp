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

}  // namespace

int view(Program& program, const std::vector<std::string>& words) {
    const window::ViewArguments split = window::split_arguments(words);
    window::ViewOptions options;
    options.words = split.scripts;
    CLI::App app(
        "Shows meshes, or the drawn or returned objects of a script, in a window. Words after a "
        "script are the script's, but for --tool, --record and --journal before a \"--\"; its "
        "parameters become sliders, and it runs again when its file changes. A file written by "
        "--record is played.",
        "lissom view");
    std::vector<std::string> files;
    std::string size = "1280x800";
    app.add_option("FILE", files, "Mesh files, one script, or one recording");
    app.add_option("--size", size, "Width and height of the window (default: 1280x800)")
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
        app.add_option(
               "--speed", options.speed,
               "How fast a recording is played, 0.02 to 60 times its own speed (default: 1)")
            ->check(CLI::Range(0.02, 60.0));
    std::string up;
    app.add_option("--up", up, "Up axis of the mesh files")->check(CLI::IsMember({"y", "z"}));
    app.add_option("--unit", options.session.load.unit,
                   "Length of the mesh files' unit: coordinates are multiplied by it (default: 1)")
        ->check(CLI::PositiveNumber);
    LoadFlags flags;
    flags.declare(app);
    app.add_flag("--tell", options.tells, "Report events of the window, for tests");
    int status = kSuccess;
    if (!program.parse(app, split.own, status)) return status;
    std::sscanf(size.c_str(), "%dx%d", &options.width, &options.height);
    if (files.size() > 1 && window::is_script(files.back())) {
        return program.fail("lissom view: give either meshes or one script", kUsage);
    }
    const bool plays = files.size() == 1 && window::is_recording(files.front());
    if (speed->count() > 0 && !plays) {
        return program.fail("lissom view: --speed is for a recording", kUsage);
    }
    if (plays && !options.tools.empty()) {
        return program.fail("lissom view: a recording brings its own tools: leave out --tool",
                            kUsage);
    }
    if (!options.tools.empty()) options.session.tool = options.tools.front();
    flags.apply(options.session.load);
    if (!up.empty()) options.session.load.up = up == "y" ? UpAxis::y : UpAxis::z;
    std::error_code error;
    for (const std::string& file : files) {
        for (const std::string& written : {options.session.record, options.session.journal}) {
            if (!std::filesystem::equivalent(file, written, error)) continue;
            return program.fail("lissom view: " + written + " is opened, and would be overwritten",
                                kUsage);
        }
    }
    options.words.insert(options.words.begin(), files.begin(), files.end());
    return window::run_view(program, options);
}

}  // namespace lissom::cli
