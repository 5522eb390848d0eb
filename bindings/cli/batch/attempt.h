/// One job of a batch while it is tried: its lock, its log, and its output until that is in place.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bindings/cli/batch/driver.h"
#include "bindings/cli/batch/job_process.h"
#include "bindings/cli/batch/staging.h"
#include "bindings/cli/process/child_process.h"

namespace lissom::cli {

/// A job that is to be tried, with the number of the attempt and the reason to run it.
struct WaitingJob {
    const BatchJob* job = nullptr;
    int attempt = 1;
    std::string reason;
    /// Names beside the output that files of other jobs have (see Staging::hold).
    std::set<std::filesystem::path> taken = {};
};

class Attempt {
  public:
    /// Takes the lock of the job, if no process of an earlier batch has it (see `is_free`).
    Attempt(const BatchPlan& plan, WaitingJob waiting, BatchState& state);

    bool is_free() const { return is_free_; }
    const BatchJob& job() const { return *waiting_.job; }
    const WaitingJob& waiting() const { return waiting_; }
    int lock() const { return lock_.descriptor(); }
    const std::filesystem::path& log() const { return log_; }

    /// Makes the folder of the output. Returns the work of the process. Errors: file_write_failed.
    JobTask prepare();
    /// Starts the clock.
    void begin() { start_ = Clock::now(); }
    double seconds() const;

    /// Returns the names that kept the outputs from their place, with those known before.
    std::set<std::filesystem::path> taken() const;

    void take(JobNews news) { news_ = std::move(news); }
    /// Notes how the process has ended the job; `timeout` above 0 for a job that took longer.
    void end(const ProcessEnd& end, double timeout = 0.0);

    /// Moves the outputs of a job that has ended well to their place, and adds the folders that are
    /// to be flushed to the disk. Returns the record.
    JobRecord conclude(BatchState& state, std::set<std::filesystem::path>& folders);

  private:
    using Clock = std::chrono::steady_clock;

    JobRecord ended_record(const BatchState& state) const;
    std::string with_place(std::string text) const;
    void publish(JobRecord& record, BatchState& state, std::set<std::filesystem::path>& folders);
    std::vector<FileStamp> read_stamps(FileDigests& digests) const;

    const BatchPlan& plan_;
    SpareFolders& spares_;
    WaitingJob waiting_;
    std::filesystem::path folder_;
    FileLock lock_;
    std::filesystem::path log_;
    bool is_free_ = false;
    std::optional<Staging> staging_;
    JobNews news_;
    ProcessEnd end_;
    double timeout_ = 0.0, seconds_ = 0.0;
    Clock::time_point start_;
};

}  // namespace lissom::cli
