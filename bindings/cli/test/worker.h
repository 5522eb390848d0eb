/// The process that runs the tests of one file, and its messages to the runner.
///
/// Each line is an object of JSON: "event", "output" (the size of the file of its output by then),
/// and
///
/// - limit: "seconds", the time limit of the step that begins
/// - begin: the "name", "line" and "folder" of the test that begins
/// - left_out: "text", the reason a picture was not compared
/// - updated: "path" of a golden picture that was written
/// - end: "status" (passed, failed or skipped) and "seconds" of that test; of a failure "message",
///   "file", "line", "code", "expectation" (whether one did not hold) and "calls"; "folder" if
///   it keeps files
/// - test: "name" and "line" of one that is only listed
/// - file: as end, for events before the first test
/// - done: the file was run to its end
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bindings/cli/json.h"
#include "bindings/cli/program.h"

namespace lissom::cli {

/// Task of a process.
struct TestJob {
    /// The script, and its name in messages.
    std::filesystem::path file;
    std::string shown;
    /// The file that all its output goes to.
    std::filesystem::path output;
    /// Folder for files of tests, each in a folder of its own below it.
    std::filesystem::path folder;
    /// Part of the names of the tests to run, or a Lua pattern of them; all if it is empty.
    std::string filter;
    bool list = false, update = false;
    long long seed = 1;
    /// Seconds a test may take; 0: any.
    double timeout = 60.0;
    /// Tests that were run by a process before this one.
    int finished = 0;
};

Json job_json(const TestJob& job);
TestJob job_of(const Json& json);

/// Runs the job, which job_json wrote.
int run_test_job(Program& program, const std::string& json);

}  // namespace lissom::cli
