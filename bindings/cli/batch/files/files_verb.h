/// Verbs that run for each of many files: the part of their command line that they share.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "bindings/cli/batch/files/file_plan.h"
#include "bindings/cli/batch/files/file_report.h"
#include "bindings/cli/batch/run/batch_run.h"

namespace lissom::cli {

class FilesVerb {
  public:
    /// `name` is the verb, "convert".
    explicit FilesVerb(std::string name) : name_(std::move(name)) { run_.options.packs = true; }

    /// Lets `app` fill these values: --in, and how the jobs run. The options that `app` has by now
    /// go to each job, if they are given.
    void declare(CLI::App& app);
    /// Parses the words of the verb, see Program::parse. Words after "--" go to sbatch if the
    /// verb is for many files, and are files otherwise.
    bool parse(Program& program, CLI::App& app, const std::vector<std::string>& words, int& status);

    /// Returns whether files are given by --in.
    bool is_for_many() const { return !files.in.empty(); }
    /// Returns the defect of words for few files, those that are given without --in; or "": an
    /// option that only many files have, or a folder.
    std::string misuse(const CLI::App& app, const std::vector<std::string>& few) const;

    /// Runs the verb for each file, with `out_option` (see `plan_files`). The options `own` do not
    /// go to the jobs. Returns the exit status.
    int run(Program& program, const CLI::App& app, const std::set<std::string>& own,
            const std::string& out_option, FileReportOptions report);

    ManyFiles files;

  private:
    std::string stray_option(const CLI::App& app) const;
    std::vector<std::string> job_words(const CLI::App& app, const std::set<std::string>& own) const;

    std::string name_;
    RunWords run_;
    std::set<std::string> of_jobs_, of_many_;
};

}  // namespace lissom::cli
