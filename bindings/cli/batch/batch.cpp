// lissom batch SCRIPT --over FILES --out TEMPLATE
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include "bindings/cli/batch/cluster/cluster.h"
#include "bindings/cli/batch/job_process.h"
#include "bindings/cli/batch/plan/plan.h"
#include "bindings/cli/batch/run/batch_run.h"
#include "bindings/cli/batch/run/progress_writer.h"
#include "bindings/cli/batch/run/stray_words.h"
#include "bindings/cli/batch/summary.h"
#include "bindings/cli/json.h"
#include "bindings/cli/verbs.h"

namespace lissom::cli {
namespace {

struct Wanted {
    BatchWords words;
    RunWords run;
    // Not for users: the tasks of a process that a batch has started, and of a cluster.
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
              "A job for each value: NAME=a,b,c, NAME=0:90:15 (by a step), NAME=0:90/7 (a count), "
              "'NAME=*' (all choices of the parameter)");
    add_words("--set", wanted.words.set, "NAME=VALUE for all jobs");
    app.add_option(
        "--out", wanted.words.out,
        "Output of each job, with {parameter}, {name}, {ext} and {dir} of its file, {n}");
    declare_run(app, wanted.run);
    app.add_option("--job", wanted.job)->group("");
    app.add_option("--submission", wanted.submission)->group("");
    app.add_option("--task", wanted.task)->group("");
    app.add_flag("--collect", wanted.collect)->group("");
    app.allow_extras();
}

// The error of words that are missing or too many, or "".
std::string wrong_words(const CLI::App& app, const Wanted& wanted) {
    if (const std::vector<std::string> stray = app.remaining(); !stray.empty()) {
        std::vector<std::string> names;
        for (const CLI::Option* option : app.get_options()) {
            if (!option->get_group().empty()) names.push_back(option->get_name());
        }
        return stray_words_error(stray, {names.begin(), names.end()}, !wanted.words.over.empty());
    }
    if (wanted.words.script.empty()) return "SCRIPT is missing";
    if (wanted.words.out.empty()) return "--out is missing, as --out 'out/{name}.obj'";
    return {};
}

// Tells each failure at once, and counts at the end.
class ScriptReport : public BatchReport {
  public:
    ScriptReport(Program& program, const BatchPlan& plan) : program_(program), plan_(plan) {}

    void ended(const BatchJob& job, const JobRecord& record) override {
        if (record.is_done() || program_.json()) return;
        program_.clear_progress();
        std::cout << record.outcome << "  " << job.output.string() << arguments_text(job)
                  << "\n    " << record.message
                  << "\n    log: " << (plan_.folder / record.log).string() << std::endl;
    }

    void kept(const BatchJob& /*job*/, const JobRecord& /*record*/) override {}

    void finish(const BatchState& state, const BatchProgress& progress) override {
        const bool stopped = progress.ended() < progress.all;
        if (!program_.json()) return print(progress, stopped);
        Json json = progress_json(progress);
        json["stopped"] = stopped;
        json["summary"] = summary_json(plan_, state);
        program_.answer(json_text(json));
    }

  private:
    void print(const BatchProgress& progress, bool stopped) const {
        std::cout << progress.all << " jobs: " << progress.done << " done";
        if (progress.kept > 0) std::cout << ", " << progress.kept << " done before";
        if (progress.failed > 0) std::cout << ", " << progress.failed << " failed";
        if (stopped) std::cout << ", " << progress.all - progress.ended() << " left";
        if (stopped) std::cout << " (the same command goes on)";
        std::cout << "; " << (plan_.folder / "index.html").string() << std::endl;
    }

    Program& program_;
    const BatchPlan& plan_;
};

// A task of a cluster, or the one that comes last.
int run_submitted(Program& program, const Wanted& wanted) {
    const Submission submission = read_submission(wanted.submission);
    if (wanted.collect) {
        std::filesystem::current_path(submission.directory);
        write_summary(submission.plan, BatchState(submission.plan));
        return kSuccess;
    }
    program.context();
    BatchOptions options = submission.options;
    ScriptReport report(program, submission.plan);
    options.stopped = [&program] { return program.interrupted(); };
    options.ended = [&report](const BatchJob& job, const JobRecord& record) {
        report.ended(job, record);
    };
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
    int status = kSuccess;
    if (!program.parse(app, take_sbatch_words(words, wanted.run), status)) return status;
    if (!wanted.submission.empty()) return run_submitted(program, wanted);
    if (!wanted.job.empty()) return run_jobs(program, wanted.job);
    if (const std::string error = wrong_words(app, wanted); !error.empty()) {
        return program.fail("lissom batch: " + error + " (see lissom batch --help)", kUsage);
    }
    BatchPlan plan;
    try {
        complete_run(program, wanted.run);
        plan = make_plan(script_parameters(program, wanted.words.script), wanted.words);
    } catch (const Error& error) {
        return program.fail("lissom batch: " + error.message(), kUsage);
    }
    ScriptReport report(program, plan);
    return run_plan(program, plan, wanted.run, report);
}

}  // namespace lissom::cli
