// lissom test PATH...
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <thread>

#include "bindings/cli/json.h"
#include "bindings/cli/test/report.h"
#include "bindings/cli/test/runner.h"
#include "bindings/cli/test/test_files.h"
#include "bindings/cli/test/worker.h"
#include "bindings/cli/verbs.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

struct Wanted {
    std::vector<std::string> paths;
    RunnerOptions runner;
    std::string format = "text";
    std::string output;
    bool verbose = false;
    // Not for users: the task of a process started by another one.
    std::string job;
};

void declare(CLI::App& app, Wanted& wanted) {
    app.add_option("PATH", wanted.paths,
                   "Files, or folders: in these *_test.lua, and below scenes/ all that have tests");
    app.add_option("--filter", wanted.runner.filter,
                   "Run only tests whose name contains this, or fits it as a Lua pattern");
    app.add_flag("--list", wanted.runner.list, "List the tests and run none");
    app.add_flag("--update", wanted.runner.update,
                 "Write golden pictures that are missing or differ, and say which");
    app.add_option("--jobs", wanted.runner.jobs, "Files at a time (default: one for each core)")
        ->check(CLI::Range(1, 1024));
    app.add_option("--timeout", wanted.runner.timeout,
                   "Seconds a test may take; 0: any (default: 60)")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--seed", wanted.runner.seed,
                   "math.random begins with it in every test (default: 1)");
    app.add_option("--format", wanted.format, "text (default), tap, junit or json")
        ->check(CLI::IsMember({"text", "tap", "junit", "json"}));
    app.add_option("--output", wanted.output,
                   "Write the report to this file; the standard output gets the text");
    app.add_flag("--verbose", wanted.verbose, "Name every test, and show its output");
    app.add_option("--job", wanted.job)->group("");
}

int core_count() {
    return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

// Number of files at a time, and threads of each.
void share_cores(RunnerOptions& options, int files, int threads, bool has_jobs) {
    options.jobs = std::clamp(has_jobs ? options.jobs : core_count(), 1, std::max(1, files));
    options.threads = threads > 0 ? threads : std::max(1, core_count() / options.jobs);
}

std::string report_text(const Wanted& wanted, const std::vector<FileResult>& results,
                        double seconds) {
    if (wanted.format == "tap") return tap_text(results);
    if (wanted.format == "junit") return junit_text(results, seconds);
    if (wanted.format == "json") return json_text(results_json(results, seconds)) + "\n";
    std::string text;
    TestCounts counts;
    for (const FileResult& result : results) {
        text += file_text(result, wanted.verbose);
        counts.add(result);
    }
    return text + counts_text(counts, seconds) + "\n";
}

int list_tests(Program& program, const std::vector<FileResult>& results) {
    if (program.json()) {
        std::cout << json_text(list_json(results)) << std::endl;
    } else {
        std::cout << list_text(results) << std::flush;
    }
    for (const FileResult& file : results) {
        for (const TestResult& test : file.tests) {
            if (test.status != TestStatus::failed) continue;
            return program.fail(file.file + ": " + test.message);
        }
    }
    return kSuccess;
}

// Runs the files; prints results as text on the way if that is wanted.
class TestRun {
  public:
    TestRun(Program& program, Wanted& wanted)
        : program_(program),
          wanted_(wanted),
          writes_text_(!wanted.runner.list && (wanted.format == "text" || !wanted.output.empty())) {
        wanted.runner.stopped = [&program] { return program.interrupted(); };
        wanted.runner.take = [this](const FileResult& result) { take(result); };
    }

    int run(const std::vector<fs::path>& files) {
        wanted_.runner.progress = [this, &files](std::size_t ended) {
            const std::string label =
                std::to_string(ended) + " of " + std::to_string(files.size()) + " files of tests";
            program_.show_progress(label, static_cast<double>(ended) / files.size());
        };
        // Ctrl-C ends the run, and not the program at once.
        program_.context();
        const auto start = std::chrono::steady_clock::now();
        run_test_files(files, wanted_.runner);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        return finish(seconds.count());
    }

  private:
    void take(const FileResult& result) {
        results_.push_back(result);
        counts_.add(result);
        if (!writes_text_) return;
        program_.clear_progress();
        std::cout << file_text(result, wanted_.verbose) << std::flush;
    }

    int finish(double seconds) {
        program_.clear_progress();
        if (program_.interrupted()) return program_.fail("lissom test: stopped by Ctrl-C");
        if (counts_.tests() == 0) {
            return program_.fail("lissom test: no test is called '" + wanted_.runner.filter + "'");
        }
        if (wanted_.runner.list) return list_tests(program_, results_);
        if (writes_text_) std::cout << counts_text(counts_, seconds) << std::endl;
        const std::string report = report_text(wanted_, results_, seconds);
        if (!wanted_.output.empty()) {
            write_file_atomically(wanted_.output, report, program_.context());
        } else if (!writes_text_) {
            std::cout << report << std::flush;
        }
        return counts_.failed == 0 ? kSuccess : kFailure;
    }

    Program& program_;
    Wanted& wanted_;
    bool writes_text_;
    std::vector<FileResult> results_;
    TestCounts counts_;
};

}  // namespace

int run_tests(Program& program, const std::vector<std::string>& words) {
    Wanted wanted;
    CLI::App app(
        "Runs the tests of scripts: test(\"name\", function() expect.equal(1 + 1, 2) end). "
        "Each file has a process of its own. Ends with status 1 if a test failed.",
        "lissom test");
    declare(app, wanted);
    int status = kSuccess;
    if (!program.parse(app, words, status)) return status;
    if (!wanted.job.empty()) return run_test_job(program, wanted.job);
    if (program.json()) wanted.format = "json";
    if (wanted.paths.empty()) {
        return program.fail("lissom test: PATH is required (see lissom test --help)", kUsage);
    }
    const std::vector<fs::path> files = find_test_files(wanted.paths);
    if (files.empty()) {
        return program.fail("lissom test: there are no tests in " + wanted.paths[0] +
                            ": *_test.lua, or scripts below scenes/");
    }
    share_cores(wanted.runner, static_cast<int>(files.size()), program.threads,
                app.count("--jobs") > 0);
    return TestRun(program, wanted).run(files);
}

}  // namespace lissom::cli
