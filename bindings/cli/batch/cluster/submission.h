/// The part of a plan that a cluster runs: a file that its tasks read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bindings/cli/batch/driver.h"
#include "bindings/cli/batch/plan/plan.h"

namespace lissom::cli {

struct Submission {
    BatchPlan plan;
    BatchOptions options;
    /// Places in `plan.jobs` of the jobs of each task.
    std::vector<std::vector<std::size_t>> tasks;
    /// Folder in which the command was given.
    std::filesystem::path directory;
    /// Time of the submission, in milliseconds since 1970.
    std::int64_t time = 0;
};

/// Seconds that a task lasts at least, if there are jobs.
inline constexpr double kTaskSeconds = 60.0;

/// Divides jobs among tasks so that a task lasts a minute or more, as far as the seconds of a job
/// are known (0: not), and there are at most `most` of them.
std::vector<std::vector<std::size_t>> divide(const std::vector<std::size_t>& jobs, double seconds,
                                             int at_a_time, std::size_t most);

/// Writes a submission, and reads it. Errors: as `write_file_atomically` and `read_file`;
/// file_syntax for a file that holds none.
void write_submission(const Submission& submission, const std::filesystem::path& file);
Submission read_submission(const std::filesystem::path& file);

}  // namespace lissom::cli
