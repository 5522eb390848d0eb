#include "bindings/cli/batch/run/batch_run.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <thread>

#include "bindings/cli/batch/cluster/cluster.h"
#include "bindings/cli/batch/run/progress_writer.h"
#include "bindings/cli/batch/summary.h"
#include "bindings/cli/json.h"

namespace lissom::cli {
namespace {

int list_plan(const Program& program, const BatchPlan& plan, BatchState& state) {
    Json jobs = Json::array();
    for (const BatchJob& job : plan.jobs) {
        const std::string reason =
            job.refused ? "refused: " + job.refused->message() : state.reason_to_run(job);
        if (!program.json()) {
            std::cout << job.output.string() << arguments_text(job) << "  ["
                      << (reason.empty() ? "done" : reason) << "]\n";
            continue;
        }
        Json arguments = Json::object();
        for (const auto& [name, value] : job.arguments) arguments[name] = value;
        jobs.push_back({{"number", job.number},
                        {"output", job.output.string()},
                        {"arguments", arguments},
                        {"done", reason.empty()},
                        {"reason", reason}});
    }
    if (program.json()) std::cout << json_text({{"jobs", jobs}}) << std::endl;
    return kSuccess;
}

int export_plan(const BatchPlan& plan, BatchState& state, const RunWords& words) {
    std::string line;
    for (const std::string& word :
         export_to_slurm(plan, state, words.options, words.export_file, words.for_sbatch)) {
        line += (line.empty() ? "" : " ") + word;
    }
    std::cout << line << std::endl;
    return kSuccess;
}

// Ctrl-C ends the batch, and not the program at once.
void listen(Program& program, ProgressWriter& writer, BatchReport& report, BatchOptions& options) {
    program.context();
    options.stopped = [&program] { return program.interrupted(); };
    options.progress = [&writer](const BatchProgress& progress) { writer.show(progress); };
    options.ended = [&report](const BatchJob& job, const JobRecord& record) {
        report.ended(job, record);
    };
    options.kept = [&report](const BatchJob& job, const JobRecord& record) {
        report.kept(job, record);
    };
}

int exit_status(const Program& program, const BatchProgress& progress) {
    if (progress.ended() < progress.all) return program.interrupted() ? kInterrupted : kFailure;
    return progress.failed > 0 ? kFailure : kSuccess;
}

}  // namespace

void declare_run(CLI::App& app, RunWords& words) {
    app.add_option("--jobs", words.options.jobs, "Jobs at a time (default: one for each core)")
        ->check(CLI::Range(1, 1024));
    app.add_option("--retries", words.options.retries,
                   "Number of times that a failed job is tried again (default: 1)")
        ->check(CLI::Range(0, 100));
    app.add_option("--timeout", words.options.timeout, "Seconds a job may take; 0: any (default)")
        ->check(CLI::Range(0.0, 1e9));
    app.add_option_function<std::string>(
           "--isolate",
           [&words](const std::string& word) { words.options.packs = word == "state"; },
           "process: each job in a process of its own; state: short jobs several to a process, "
           "each script in a Lua state of its own; a job that ends the process runs again alone "
           "(default: process for scripts, state for other verbs)")
        ->check(CLI::IsMember({"process", "state"}));
    app.add_option("--progress", words.progress,
                   "auto (default: a line on a terminal), plain, json or none")
        ->check(CLI::IsMember({"auto", "plain", "json", "none"}));
    app.add_flag("--list", words.list, "Print the plan, and why each job would run; run nothing");
    app.add_flag("--slurm", words.slurm,
                 "Run the jobs by Slurm, in one array; words after -- go to sbatch");
    app.add_option("--export", words.export_file,
                   "Write a script of tasks for sbatch to this file, and submit nothing");
}

std::vector<std::string> take_sbatch_words(const std::vector<std::string>& words, RunWords& run) {
    const auto rest = std::find(words.begin(), words.end(), "--");
    if (rest != words.end()) run.for_sbatch.assign(rest + 1, words.end());
    return {words.begin(), rest};
}

void complete_run(const Program& program, RunWords& words) {
    const bool elsewhere = words.slurm || !words.export_file.empty();
    if (!words.for_sbatch.empty() && !elsewhere) {
        throw Error(ErrorCode::invalid_argument, "words after -- belong to --slurm");
    }
    BatchOptions& options = words.options;
    const int cores =
        elsewhere ? 1 : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    if (options.jobs == 0) options.jobs = cores;
    options.threads = program.threads > 0 ? program.threads : std::max(1, cores / options.jobs);
}

int run_plan(Program& program, const BatchPlan& plan, RunWords& words, BatchReport& report) {
    BatchState state(plan);
    if (words.list) return list_plan(program, plan, state);
    require_own_summary(plan);
    ProgressWriter writer(program, words.progress);
    listen(program, writer, report, words.options);
    if (!words.export_file.empty()) return export_plan(plan, state, words);
    const BatchProgress progress = words.slurm
                                       ? run_on_slurm(plan, state, words.options, words.for_sbatch)
                                       : run_batch(plan, state, words.options);
    write_summary(plan, state);
    program.clear_progress();
    report.finish(state, progress);
    return exit_status(program, progress);
}

std::string arguments_text(const BatchJob& job) {
    std::string text;
    for (const auto& [name, value] : job.arguments) text += " " + name + "=" + value;
    return text;
}

}  // namespace lissom::cli
