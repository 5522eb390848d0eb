/// One job of a batch in a process of its own.
#pragma once

#include <string>
#include <vector>

#include "bindings/cli/program.h"

namespace lissom::cli {

/// Work of the process.
struct JobTask {
    std::string script;
    std::vector<std::string> words;
};

/// News of the process to the one that started it.
struct JobNews {
    /// Files that were read, modules of the script among them.
    std::vector<std::string> reads;
    int warnings = 0;
    /// Error message, or "".
    std::string message;
};

/// Returns a task or news as one line of JSON, and the news of a line. Throws on other lines.
std::string task_line(const JobTask& task);
std::string news_line(const JobNews& news);
JobNews read_news(const std::string& line);

/// Runs the task of a line in this process, which ChildProcess has started, and tells the news to
/// its parent. Returns the exit status.
int run_job(Program& program, const std::string& line);

}  // namespace lissom::cli
