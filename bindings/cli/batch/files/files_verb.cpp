#include "bindings/cli/batch/files/files_verb.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

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
    return program.parse(app, is_many ? take_sbatch_words(words, run_) : words, status);
}

std::string FilesVerb::stray_option(const CLI::App& app) const {
    if (is_for_many()) return {};
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
