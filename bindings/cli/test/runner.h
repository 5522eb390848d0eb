/// Runs files of tests, each in a process of its own and several at a time.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bindings/cli/test/results.h"

namespace lissom::cli {

struct RunnerOptions {
    std::string filter;
    bool list = false, update = false;
    long long seed = 1;
    /// Seconds a test may take; 0: any.
    double timeout = 60.0;
    /// Processes at a time, and threads of the kernel in each.
    int jobs = 1, threads = 1;
    /// Asked several times a second; true ends all processes.
    std::function<bool()> stopped;
    /// Told how many of the files have ended, as often.
    std::function<void(std::size_t ended)> progress;
    /// Takes the results in the order of the files, each as soon as those before it are there.
    std::function<void(const FileResult&)> take;
};

/// Runs the tests. A process that dies, or exceeds the time limit, fails its running test;
/// another process runs the rest of the file. If `stopped` ended them, unfinished files are
/// not reported. Returns the folder that keeps the files of failed tests; empty if there are
/// none.
std::filesystem::path run_test_files(const std::vector<std::filesystem::path>& files,
                                     const RunnerOptions& options);

}  // namespace lissom::cli
