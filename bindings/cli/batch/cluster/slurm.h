/// Slurm: one array of tasks for a batch, a task that collects, and its state.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bindings/cli/batch/cluster/submission.h"

namespace lissom::cli {

/// An array that was submitted.
struct SlurmArray {
    /// Id of the array, and the name of its job, which no other has: ids are used again.
    std::string id, name;
};

/// State of an array as Slurm tells.
enum class SlurmState { waits_or_runs, ended, unknown };

/// Returns the greatest number of tasks that an array of this cluster may have; 1000 if it does not
/// tell.
std::size_t max_tasks();

/// Returns the text of the script that runs task SLURM_ARRAY_TASK_ID of the submission in `file`.
std::string task_script(const std::filesystem::path& file);

/// Returns the words of sbatch for a script: the array, its logs in `logs`, requeued if a node
/// fails and told a minute before its time ends; `more` comes last.
std::vector<std::string> sbatch_words(const Submission& submission, const std::string& name,
                                      const std::filesystem::path& logs,
                                      const std::filesystem::path& script,
                                      const std::vector<std::string>& more);

/// Submits the submission in `file`, and a task after it that writes the summary. Errors:
/// file_not_found if sbatch is not installed; invalid_argument with the message of an sbatch that
/// refuses.
SlurmArray submit(const Submission& submission, const std::filesystem::path& file,
                  const std::vector<std::string>& more);

/// Returns the state of an array, by one call of squeue.
SlurmState slurm_state(const SlurmArray& array);

/// Ends the tasks of an array that have nothing left to do. Failures are passed over.
void cancel(const SlurmArray& array);

}  // namespace lissom::cli
