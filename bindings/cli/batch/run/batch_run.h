/// Runs a plan as a command line asks: here or by Slurm, with a report for people and programs.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/batch/driver.h"
#include "bindings/cli/batch/plan/plan.h"
#include "bindings/cli/program.h"

namespace CLI {
class App;
}

namespace lissom::cli {

/// The part of a command line that all verbs over many files have.
struct RunWords {
    BatchOptions options;
    std::string progress = "auto";
    bool list = false;
    bool slurm = false;
    std::string export_file;
    /// Words after "--".
    std::vector<std::string> for_sbatch;
};

/// Hears of the jobs of a plan, and tells what came of them.
class BatchReport {
  public:
    virtual ~BatchReport() = default;

    /// Hears of a job that has ended now.
    virtual void ended(const BatchJob& job, const JobRecord& record) = 0;
    /// Hears of a job that was done before.
    virtual void kept(const BatchJob& job, const JobRecord& record) = 0;
    /// Writes the report of the whole.
    virtual void finish(const BatchState& state, const BatchProgress& progress) = 0;
};

/// Lets `app` fill these values, which must outlive its parsing.
void declare_run(CLI::App& app, RunWords& words);
/// Takes the words after the first "--" from the words of a verb, for sbatch. Returns those before.
std::vector<std::string> take_sbatch_words(const std::vector<std::string>& words, RunWords& run);
/// Enters processes and threads that are not given, by the cores of this machine. Errors:
/// invalid_argument for words after "--" without --slurm.
void complete_run(const Program& program, RunWords& words);

/// Lists the plan, exports or runs it, and writes its summary. Returns the exit status.
int run_plan(Program& program, const BatchPlan& plan, RunWords& words, BatchReport& report);

/// Returns " name=value" for each argument of a job.
std::string arguments_text(const BatchJob& job);

}  // namespace lissom::cli
