/// Jobs of a batch in a process of their own.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bindings/cli/program.h"

namespace lissom::cli {

/// Work of the process.
struct JobTask {
    /// Script to run with the words; empty if they are a verb of the program and its words.
    std::string script;
    std::vector<std::string> words;
    /// File that takes the outputs of the job.
    std::string log;
};

/// News of the process to the one that started it, at the end of each job.
struct JobNews {
    /// Exit status of the job, seconds of processors that it took, and the greatest memory of the
    /// process until then, in bytes.
    int status = 0;
    double cpu_seconds = 0.0;
    std::uint64_t memory = 0;
    /// Files that were read, modules of the script among them.
    std::vector<std::string> reads;
    int warnings = 0;
    /// Error message, or "".
    std::string message;
    /// Answer of a verb as JSON, or "".
    std::string result;
};

/// Returns tasks or news as one line of JSON, and the news of a line. Throws on other lines.
std::string tasks_line(const std::vector<JobTask>& tasks);
std::string news_line(const JobNews& news);
JobNews read_news(const std::string& line);

/// Runs the tasks of a line in this process, which ChildProcess has started, each script in a Lua
/// state of its own, and tells the news of each to its parent. Returns the exit status of the last
/// one.
int run_jobs(Program& program, const std::string& line);

}  // namespace lissom::cli
