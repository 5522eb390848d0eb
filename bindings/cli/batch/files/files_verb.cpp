#include "bindings/cli/batch/files/files_verb.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <utility>

#include "bindings/cli/batch/run/stray_words.h"
#include "bindings/cli/scene_input.h"

namespace lissom::cli {
namespace {

std::set<std::string> option_names(const CLI::App& app) {
    std::set<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        if (!option->get_positional()) names.insert(option->get_name());
    }
    names.erase("--help");
    return names;
}

// The error of words behind all that a verb takes.
std::string stray_error(const CLI::App& app, const std::vector<std::string>& stray) {
    const std::set<std::string> names = option_names(app);
    return stray_files_error(stray, {names.begin(), names.end()});
}

}  // namespace

void FilesVerb::declare(CLI::App& app) {
    of_jobs_ = option_names(app);
    app.add_option("--in", files.in,
                   "Files to read: names, folders (the mesh and hair files in them) or patterns in "
                   "quotes, with * and ? in names and ** for any folders");
    const std::set<std::string> before = option_names(app);
    declare_run(app, run_);
    for (const std::string& name : option_names(app)) {
        if (!before.contains(name)) of_many_.insert(name);
    }
}

bool FilesVerb::parse(Program& program, CLI::App& app, const std::vector<std::string>& words,
                      int& status) {
    const bool is_many = std::find(words.begin(), words.end(), "--in") != words.end();
    app.allow_extras();
    if (!program.parse(app, is_many ? take_sbatch_words(words, run_) : words, status)) return false;
    std::vector<std::string> stray = app.remaining();
    // The mark before names of files.
    std::erase(stray, "--");
    if (stray.empty()) return true;
    const std::string error = app.get_name() + ": " + stray_error(app, stray);
    status = program.fail(error + " (see " + app.get_name() + " --help)", kUsage);
    return false;
}

std::string FilesVerb::misuse(const CLI::App& app, const std::vector<std::string>& few) const {
    if (is_for_many()) return {};
    const std::string stray = stray_option(app);
    if (!stray.empty()) return stray + " is for many files, which --in names";
    for (const std::string& file : few) {
        std::error_code error;
        if (!std::filesystem::is_directory(file, error) || is_scene_path(file)) continue;
        return file + " is a folder: its files are given by --in " + file;
    }
    return {};
}

std::string FilesVerb::stray_option(const CLI::App& app) const {
    const auto given = std::find_if(of_many_.begin(), of_many_.end(),
                                    [&](const std::string& name) { return app.count(name) > 0; });
    return given != of_many_.end() ? *given : std::string();
}

int FilesVerb::run(Program& program, const CLI::App& app, const std::set<std::string>& own,
                   const std::string& out_option, FileReportOptions report) {
    try {
        complete_run(program, run_);
    } catch (const Error& error) {
        return program.fail("lissom " + name_ + ": " + error.message(), kUsage);
    }
    const BatchPlan plan = plan_files(files, job_words(app, own), out_option);
    FileReport rows(program, plan, std::move(report));
    return run_plan(program, plan, run_, rows);
}

// The verb, and the options for each job as they were given.
std::vector<std::string> FilesVerb::job_words(const CLI::App& app,
                                              const std::set<std::string>& own) const {
    std::vector<std::string> words = {name_};
    for (const CLI::Option* option : app.get_options()) {
        const std::string name = option->get_name();
        if (option->count() == 0 || !of_jobs_.contains(name) || own.contains(name)) continue;
        if (option->get_expected_min() == 0) {
            words.push_back(name);
        } else if (const char delimiter = option->get_delimiter(); delimiter != '\0') {
            words.push_back(name + "=" +
                            CLI::detail::join(option->results(), std::string(1, delimiter)));
        } else {
            for (const std::string& value : option->results()) words.push_back(name + "=" + value);
        }
    }
    return words;
}

}  // namespace lissom::cli
