/// Runs the jobs of a plan, several processes at a time.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "bindings/cli/batch/durable_files.h"
#include "bindings/cli/batch/ledger.h"
#include "bindings/cli/batch/plan/plan.h"
#include "bindings/cli/batch/spare_folders.h"

namespace lissom::cli {

/// Progress of a batch.
struct BatchProgress {
    /// Jobs of the plan; done before, done now, and failed in all their attempts.
    std::size_t all = 0, kept = 0, done = 0, failed = 0;
    double seconds = 0.0;

    std::size_t ended() const { return kept + done + failed; }
    /// Jobs a second since the start, without those done before.
    double rate() const;
    /// Seconds until the end as the rate tells; below 0 if nothing is known yet.
    double seconds_left() const;
};

struct BatchOptions {
    /// Processes at a time, 0 for as many as there are cores (see `complete_run`); threads of each.
    int jobs = 0, threads = 1;
    /// Attempts after the first of a job that failed, but not of one that was called wrongly, or
    /// of a verb that told its error.
    int retries = 1;
    /// Seconds that an attempt may take; 0: any.
    double timeout = 0.0;
    /// A process runs several jobs, each in a Lua state of its own, instead of one. If a job ends
    /// the process, it is tried again alone, and the jobs behind it start in another process.
    bool packs = false;
    /// Returns whether the batch shall stop; asked often.
    std::function<bool()> stopped;
    /// Hears of each job that starts, with the reason, of each that ends, and of each that was done
    /// before.
    std::function<void(const BatchJob& job, const std::string& reason)> started;
    std::function<void(const BatchJob& job, const JobRecord& record)> ended;
    std::function<void(const BatchJob& job, const JobRecord& record)> kept;
    /// Hears of the state a few times each second.
    std::function<void(const BatchProgress&)> progress;
    /// Other processes may work on other jobs of the folder, as the tasks of a cluster do.
    bool shares_folder = false;
    /// Leave jobs to other processes that work on them, instead of waiting for their end.
    bool leaves_taken = false;
};

/// Folder of the records, logs and locks of a batch below that of its outputs.
inline constexpr const char* kBatchFolder = ".batch";

/// Records of one program's jobs, and the files that they depend on.
class BatchState {
  public:
    explicit BatchState(const BatchPlan& plan);

    /// Returns the reason to run a job: "new", "in/cow.obj has changed"; "" for one that is done:
    /// program, script, arguments and inputs are as they were, and outputs as they were written.
    std::string reason_to_run(const BatchJob& job);
    /// Returns the last record of a job, or null; also for one that is refused.
    const JobRecord* record(const BatchJob& job) const {
        return job.refused ? nullptr : ledger_.find(job.output.string());
    }
    void add(const std::vector<JobRecord>& records) { ledger_.add(records); }

    /// Reads the records that other processes have added.
    void refresh() { ledger_.refresh(); }

    FileDigests& digests() { return digests_; }
    SpareFolders& spares() { return spares_; }
    const std::string& program() const { return program_; }
    std::filesystem::path folder() const { return folder_; }

  private:
    std::string changed_argument(const BatchJob& job, const JobRecord& record) const;

    std::filesystem::path folder_;
    std::string program_;
    FileDigests digests_;
    SpareFolders spares_;
    Ledger ledger_;
};

/// Returns the record of the failure of a job that is refused.
JobRecord refused_record(const BatchJob& job);

/// Takes the lock of the folder of a batch, or a part of it, after making the folder. Errors:
/// file_write_failed, also if another process has it.
std::unique_ptr<FileLock> lock_batch(const BatchPlan& plan, const BatchState& state, bool shares);

/// Runs the open jobs, with the lock of the folder. Errors: file_write_failed, also if the disk
/// is full: jobs that have ended are kept.
BatchProgress run_batch(const BatchPlan& plan, BatchState& state, const BatchOptions& options);

}  // namespace lissom::cli
