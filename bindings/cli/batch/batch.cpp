// lissom batch SCRIPT --over FILES --out TEMPLATE
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "bindings/cli/batch/cluster/cluster.h"
#include "bindings/cli/batch/driver.h"
#include "bindings/cli/batch/job_process.h"
#include "bindings/cli/batch/plan.h"
#include "bindings/cli/batch/summary.h"
#include "bindings/cli/json.h"
#include "bindings/cli/verbs.h"

namespace lissom::cli {
namespace {

struct Wanted {
    BatchWords words;
    BatchOptions options;
    std::string progress = "auto";
    bool list = false;
    bool slurm = false;
    std::string export_file;
    // Words after "--".
    std::vector<std::string> for_sbatch;
    // Not for users: the task of a process that a batch has started, and the tasks of a cluster.
    std::string job, submission;
    int task = -1;
    bool collect = false;
};

void declare(CLI::App& app, Wanted& wanted) {
    const auto add_words = [&app](const char* name, std::vector<std::string>& words,
                                  const char* help) {
        app.add_option(name, words, help)->allow_extra_args(false);
    };
    app.add_option("SCRIPT", wanted.words.script, "A script with parameters (lissom.params)");
    add_words("--over", wanted.words.over,
              "A job for each file that a pattern names, or for each row of a table (.csv); "
              "NAME=PATTERN names the parameter; repeatable: all combinations");
    add_words("--sweep", wanted.words.sweep,
              "A job for each value: NAME=a,b,c, NAME=0:90:15 (by a step), NAME=0:90/7 (a count)");
    add_words("--set", wanted.words.set, "NAME=VALUE for all jobs");
    app.add_option(
        "--out", wanted.words.out,
        "Output of each job, with {parameter}, {name}, {ext} and {dir} of its file, {n}");
    app.add_option("--jobs", wanted.options.jobs, "Jobs at a time (default: one for each core)")
        ->check(CLI::Range(1, 1024));
    app.add_option("--retries", wanted.options.retries,
                   "How often a failed job is tried again (default: 1)")
        ->check(CLI::Range(0, 100));
    app.add_option("--timeout", wanted.options.timeout, "Seconds a job may take; 0: any (default)")
        ->check(CLI::NonNegativeNumber);
    app.add_option_function<std::string>(
           "--isolate",
           [&wanted](const std::string& word) { wanted.options.packs = word == "state"; },
           "process (default): each job in a process of its own; state: short jobs several to a "
           "process, each in a Lua state of its own; a job that ends the process runs again alone")
        ->check(CLI::IsMember({"process", "state"}));
    app.add_option("--progress", wanted.progress,
                   "auto (default: a line on a terminal), plain, json or none")
        ->check(CLI::IsMember({"auto", "plain", "json", "none"}));
    app.add_flag("--list", wanted.list, "Print the plan, and why each job would run; run nothing");
    app.add_flag("--slurm", wanted.slurm,
                 "Run the jobs by Slurm, in one array; words after -- go to sbatch");
    app.add_option("--export", wanted.export_file,
                   "Write a script of tasks for sbatch to this file, and submit nothing");
    app.add_option("--job", wanted.job)->group("");
    app.add_option("--submission", wanted.submission)->group("");
    app.add_option("--task", wanted.task)->group("");
    app.add_flag("--collect", wanted.collect)->group("");
}

std::string arguments_text(const BatchJob& job) {
    std::string text;
    for (const auto& [name, value] : job.arguments) text += " " + name + "=" + value;
    return text;
}

int list_plan(const Program& program, const BatchPlan& plan, BatchState& state) {
    Json jobs = Json::array();
    for (const BatchJob& job : plan.jobs) {
        const std::string reason = state.reason_to_run(job);
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

std::string duration_text(double seconds) {
    if (seconds < 0.0) return "?";
    const auto whole = static_cast<long long>(std::min(seconds, 1e9) + 0.5);
    if (whole < 120) return std::to_string(whole) + " s";
    if (whole < 7200) return std::to_string(whole / 60) + " min";
    return std::to_string(whole / 3600) + " h";
}

std::string rate_text(double rate) {
    const double shown = rate >= 1.0 ? rate : 60.0 * rate;
    return number_text(std::round(10.0 * shown) / 10.0) + (rate >= 1.0 ? " a second" : " a minute");
}

std::string progress_text(const BatchProgress& progress) {
    std::string text =
        std::to_string(progress.ended()) + " of " + std::to_string(progress.all) + " jobs";
    if (progress.failed > 0) text += ", " + std::to_string(progress.failed) + " failed";
    if (progress.rate() > 0.0) {
        text += ", " + rate_text(progress.rate()) + ", " + duration_text(progress.seconds_left()) +
                " left";
    }
    return text;
}

Json progress_json(const BatchProgress& progress) {
    return {
        {"all", progress.all},
        {"kept", progress.kept},
        {"done", progress.done},
        {"failed", progress.failed},
        {"rate", progress.rate()},
        {"seconds", progress.seconds},
        {"seconds_left", progress.seconds_left() < 0.0 ? Json() : Json(progress.seconds_left())}};
}

class ProgressWriter {
  public:
    ProgressWriter(Program& program, std::string form)
        : program_(program), form_(std::move(form)) {}

    void show(const BatchProgress& progress) {
        if (form_ == "auto") {
            const double fraction =
                progress.all > 0 ? static_cast<double>(progress.ended()) / progress.all : 1.0;
            program_.show_progress(progress_text(progress), fraction);
        } else if (form_ != "none" &&
                   (progress.seconds >= next_ || progress.ended() == progress.all)) {
            next_ = progress.seconds + 1.0;
            std::cerr << (form_ == "json" ? json_text(progress_json(progress), -1)
                                          : progress_text(progress))
                      << std::endl;
        }
    }

  private:
    Program& program_;
    std::string form_;
    double next_ = 0.0;
};

void report_failure(Program& program, const BatchPlan& plan, const BatchJob& job,
                    const JobRecord& record) {
    if (record.is_done() || program.json()) return;
    program.clear_progress();
    std::cout << record.outcome << "  " << job.output.string() << arguments_text(job) << "\n    "
              << record.message << "\n    log: " << (plan.folder / record.log).string()
              << std::endl;
}

int report_end(Program& program, const BatchPlan& plan, const BatchState& state,
               const BatchProgress& progress) {
    program.clear_progress();
    const bool stopped = progress.ended() < progress.all;
    if (program.json()) {
        Json json = progress_json(progress);
        json["stopped"] = stopped;
        json["summary"] = summary_json(plan, state);
        std::cout << json_text(json) << std::endl;
    } else {
        std::cout << progress.all << " jobs: " << progress.done << " done";
        if (progress.kept > 0) std::cout << ", " << progress.kept << " done before";
        if (progress.failed > 0) std::cout << ", " << progress.failed << " failed";
        if (stopped) std::cout << ", " << progress.all - progress.ended() << " left";
        if (stopped) std::cout << " (the same command goes on)";
        std::cout << "; " << (plan.folder / "index.html").string() << std::endl;
    }
    if (stopped) return program.interrupted() ? kInterrupted : kFailure;
    return progress.failed > 0 ? kFailure : kSuccess;
}

void listen(Program& program, const BatchPlan& plan, ProgressWriter& writer,
            BatchOptions& options) {
    // Ctrl-C ends the batch, and not the program at once.
    program.context();
    options.stopped = [&program] { return program.interrupted(); };
    options.progress = [&writer](const BatchProgress& progress) { writer.show(progress); };
    options.ended = [&program, &plan](const BatchJob& job, const JobRecord& record) {
        report_failure(program, plan, job, record);
    };
}

int export_plan(const BatchPlan& plan, BatchState& state, const Wanted& wanted) {
    std::string line;
    for (const std::string& word :
         export_to_slurm(plan, state, wanted.options, wanted.export_file, wanted.for_sbatch)) {
        line += (line.empty() ? "" : " ") + word;
    }
    std::cout << line << std::endl;
    return kSuccess;
}

int run_plan(Program& program, const BatchPlan& plan, Wanted& wanted) {
    BatchState state(plan);
    if (wanted.list) return list_plan(program, plan, state);
    ProgressWriter writer(program, wanted.progress);
    listen(program, plan, writer, wanted.options);
    if (!wanted.export_file.empty()) return export_plan(plan, state, wanted);
    const BatchProgress progress =
        wanted.slurm ? run_on_slurm(plan, state, wanted.options, wanted.for_sbatch)
                     : run_batch(plan, state, wanted.options);
    write_summary(plan, state);
    return report_end(program, plan, state, progress);
}

// A task of a cluster, or the one that comes last.
int run_submitted(Program& program, Wanted& wanted) {
    const Submission submission = read_submission(wanted.submission);
    if (wanted.collect) {
        std::filesystem::current_path(submission.directory);
        write_summary(submission.plan, BatchState(submission.plan));
        return kSuccess;
    }
    ProgressWriter writer(program, "none");
    BatchOptions options = submission.options;
    listen(program, submission.plan, writer, options);
    const BatchProgress progress =
        run_task(submission, static_cast<std::size_t>(std::max(0, wanted.task)), options);
    return progress.failed > 0 || progress.ended() < progress.all ? kFailure : kSuccess;
}

}  // namespace

int batch(Program& program, const std::vector<std::string>& words) {
    CLI::App app(
        "Runs a script once for each file, row or value, several at a time. A job whose program, "
        "script, parameters and inputs are as they were, and its output as it was written, is not "
        "run again.",
        "lissom batch");
    Wanted wanted;
    declare(app, wanted);
    wanted.options.jobs = 0;
    int status = kSuccess;
    const auto rest = std::find(words.begin(), words.end(), "--");
    if (rest != words.end()) wanted.for_sbatch.assign(rest + 1, words.end());
    if (!program.parse(app, {words.begin(), rest}, status)) return status;
    if (!wanted.for_sbatch.empty() && !wanted.slurm && wanted.export_file.empty()) {
        return program.fail("lissom batch: words after -- belong to --slurm", kUsage);
    }
    if (!wanted.submission.empty()) return run_submitted(program, wanted);
    if (!wanted.job.empty()) return run_jobs(program, wanted.job);
    if (wanted.words.script.empty() || wanted.words.out.empty()) {
        return program.fail("lissom batch: SCRIPT and --out are needed (see lissom batch --help)",
                            kUsage);
    }
    const bool elsewhere = wanted.slurm || !wanted.export_file.empty();
    const int cores =
        elsewhere ? 1 : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    if (wanted.options.jobs == 0) wanted.options.jobs = cores;
    wanted.options.threads =
        program.threads > 0 ? program.threads : std::max(1, cores / wanted.options.jobs);
    BatchPlan plan;
    try {
        plan = make_plan(script_parameters(program, wanted.words.script), wanted.words);
    } catch (const Error& error) {
        return program.fail("lissom batch: " + error.message(), kUsage);
    }
    return run_plan(program, plan, wanted);
}

}  // namespace lissom::cli
