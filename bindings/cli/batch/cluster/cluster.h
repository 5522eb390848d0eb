/// A batch on a cluster: submits the open jobs, and watches.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bindings/cli/batch/cluster/submission.h"
#include "bindings/cli/batch/driver.h"

namespace lissom::cli {

/// Jobs of a plan that are not done, divided among tasks. Locks the folder for that long.
Submission make_submission(const BatchPlan& plan, BatchState& state, const BatchOptions& options,
                           std::size_t max_tasks);

/// Submits the open jobs to Slurm and waits until it has ended, or watches the array that was
/// submitted before and has not ended. `more` are words for sbatch. If `options.stopped` says so it
/// returns, and the array goes on. Errors: as `submit`.
BatchProgress run_on_slurm(const BatchPlan& plan, BatchState& state, const BatchOptions& options,
                           const std::vector<std::string>& more);

/// Writes the submission and the script of its tasks for a site that submits by its own ways, and
/// returns the words of sbatch.
std::vector<std::string> export_to_slurm(const BatchPlan& plan, BatchState& state,
                                         const BatchOptions& options,
                                         const std::filesystem::path& script,
                                         const std::vector<std::string>& more);

/// Runs a task of a submission, and jobs that other tasks have not begun until it has lasted
/// `kTaskSeconds`. Returns the progress of its own jobs. Errors: out_of_range for a task that it
/// has not.
BatchProgress run_task(const Submission& submission, std::size_t task, BatchOptions options);

}  // namespace lissom::cli
