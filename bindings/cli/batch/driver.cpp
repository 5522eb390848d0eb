#include "bindings/cli/batch/driver.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <fstream>
#include <memory>
#include <set>
#include <thread>

#include "bindings/cli/batch/durable_files.h"
#include "bindings/cli/batch/job_pack.h"
#include "bindings/cli/json.h"
#include "bindings/cli/process/child_process.h"
#include "kernel/core/error.h"
#include "kernel/core/version.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kProgressSeconds = 0.25, kWaitSeconds = 0.1;
// A disk with less free space is full.
constexpr std::uintmax_t kFullBytes = 1 << 20;
// Jobs of one process at most, and bytes of their tasks, which are words of its command line.
constexpr std::size_t kMaxPacked = 64, kMaxTaskBytes = 60000;
// Attempts of a job whose files beside the output have names of other files.
constexpr int kMaxNameAttempts = 20;

double seconds_after(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

bool is_full(const fs::path& folder) {
    std::error_code error;
    const fs::space_info space = fs::space(folder, error);
    return !error && space.available < kFullBytes;
}

bool is_tried_again(const JobRecord& record, const BatchOptions& options) {
    const bool is_certain =
        record.outcome == "failed" && (record.status == kUsage || !record.result.empty());
    return !record.is_done() && !is_certain && record.attempts <= options.retries;
}

class Driver {
  public:
    Driver(const BatchPlan& plan, BatchState& state, const BatchOptions& options)
        : plan_(plan), state_(state), options_(options) {}

    BatchProgress run() {
        progress_.all = plan_.jobs.size();
        find_work();
        start_jobs();
        while ((!waiting_.empty() || !running_.empty()) && !options_.stopped()) {
            wait();
            const Attempts ended = take_ended();
            // Others run while these are brought to the disk.
            start_jobs();
            conclude(ended);
            tell_progress(false);
        }
        running_.clear();
        tell_progress(true);
        return progress_;
    }

  private:
    void find_work() {
        for (const BatchJob& job : plan_.jobs) {
            if (options_.stopped()) return;
            if (job.refused) {
                ++progress_.failed;
                if (options_.ended) options_.ended(job, refused_record(job));
                continue;
            }
            std::string reason = state_.reason_to_run(job);
            if (reason.empty()) {
                keep(job);
            } else {
                waiting_.push_back({&job, 1, std::move(reason), {}});
            }
        }
    }

    void keep(const BatchJob& job) {
        ++progress_.kept;
        if (options_.kept) options_.kept(job, *state_.record(job));
    }

    void start_jobs() {
        const auto most = static_cast<std::size_t>(options_.jobs);
        while (running_.size() < most) {
            Attempts attempts = next_pack();
            if (attempts.empty()) return;
            if (options_.started) {
                for (const auto& attempt : attempts) {
                    options_.started(attempt->job(), attempt->waiting().reason);
                }
            }
            running_.push_back(std::make_unique<JobPack>(std::move(attempts), options_));
        }
    }

    // So many that all processes have work to the end.
    std::size_t pack_size() const {
        if (!options_.packs) return 1;
        const auto processes = static_cast<std::size_t>(options_.jobs);
        return std::clamp<std::size_t>(waiting_.size() / (4 * processes), 1, kMaxPacked);
    }

    // The next jobs that are free. A job that has failed is tried again alone.
    Attempts next_pack() {
        Attempts pack;
        std::size_t bytes = 0;
        const std::size_t size = pack_size();
        for (std::size_t tries = waiting_.size(); tries > 0 && pack.size() < size; --tries) {
            bytes += task_bytes(*waiting_.front().job);
            const bool is_alone = waiting_.front().attempt > 1;
            if (!pack.empty() && (is_alone || bytes > kMaxTaskBytes)) break;
            WaitingJob next = std::move(waiting_.front());
            waiting_.pop_front();
            auto attempt = std::make_unique<Attempt>(plan_, next, state_);
            if (!attempt->is_free()) {
                if (!options_.leaves_taken) waiting_.push_back(std::move(next));
                continue;
            }
            if (options_.shares_folder && next.attempt == 1 && is_done_elsewhere(*next.job)) {
                keep(*next.job);
                continue;
            }
            pack.push_back(std::move(attempt));
            if (is_alone) break;
        }
        return pack;
    }

    std::size_t task_bytes(const BatchJob& job) const {
        std::size_t bytes = plan_.name().size() + 2 * plan_.folder.string().size() + 200;
        for (const auto& [name, value] : job.arguments) bytes += name.size() + 2 * value.size() + 8;
        return bytes;
    }

    // To be asked with the lock of the job, which another process may have had.
    bool is_done_elsewhere(const BatchJob& job) {
        state_.refresh();
        return state_.reason_to_run(job).empty();
    }

    void wait() const {
        std::vector<const ChildProcess*> processes;
        for (const auto& pack : running_) processes.push_back(&pack->process());
        ChildProcess::wait(processes, kWaitSeconds);
    }

    // Jobs to which a process did not come wait again.
    Attempts take_ended() {
        Attempts ended;
        for (auto& pack : running_) {
            for (auto& attempt : pack->take_ended()) ended.push_back(std::move(attempt));
            if (!pack->has_ended()) continue;
            for (const auto& other : pack->take_others()) waiting_.push_back(other->waiting());
            pack.reset();
        }
        std::erase(running_, nullptr);
        return ended;
    }

    // All at once, as the disk takes as long for one as for several.
    void conclude(const Attempts& ended) {
        if (ended.empty()) return;
        std::set<fs::path> folders;
        std::vector<JobRecord> records;
        for (const auto& attempt : ended) records.push_back(attempt->conclude(state_, folders));
        require_space(records);
        for (const fs::path& folder : folders) flush_to_disk(folder);
        state_.add(records);
        for (std::size_t i = 0; i < ended.size(); ++i) settle(*ended[i], records[i]);
    }

    void require_space(const std::vector<JobRecord>& records) const {
        const bool all_done = std::all_of(records.begin(), records.end(),
                                          [](const JobRecord& record) { return record.is_done(); });
        if (all_done || !is_full(state_.folder())) return;
        throw Error(ErrorCode::file_write_failed,
                    "the disk of " + display_name(plan_.folder) +
                        " is full: free space, and start the batch again; it goes on from here");
    }

    void settle(const Attempt& attempt, const JobRecord& record) {
        const BatchJob& job = attempt.job();
        // A verb finds other names for the files beside its output.
        std::set<fs::path> taken = attempt.taken();
        if (!plan_.verb.empty() && !taken.empty() && record.attempts < kMaxNameAttempts) {
            waiting_.push_back({&job, record.attempts + 1, record.outcome, std::move(taken)});
            return;
        }
        if (is_tried_again(record, options_)) {
            waiting_.push_back({&job, record.attempts + 1, record.outcome, {}});
            return;
        }
        ++(record.is_done() ? progress_.done : progress_.failed);
        if (options_.ended) options_.ended(job, record);
    }

    void tell_progress(bool always) {
        progress_.seconds = seconds_after(start_);
        if (!options_.progress || (!always && progress_.seconds < next_progress_)) return;
        next_progress_ = progress_.seconds + kProgressSeconds;
        options_.progress(progress_);
    }

    const BatchPlan& plan_;
    BatchState& state_;
    const BatchOptions& options_;
    BatchProgress progress_;
    std::deque<WaitingJob> waiting_;
    std::vector<std::unique_ptr<JobPack>> running_;
    Clock::time_point start_ = Clock::now();
    double next_progress_ = 0.0;
};

std::string first_line(const fs::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    return line;
}

// Work folders of processes that were killed.
void remove_abandoned_work(const fs::path& folder) {
    for (const fs::directory_entry& work : fs::directory_iterator(folder / "work")) {
        std::error_code ignored;
        if (work.path().filename().string().starts_with(SpareFolders::kName)) {
            fs::remove(work.path(), ignored);
            continue;
        }
        FileLock lock(folder / "locks" / work.path().stem());
        if (lock.take()) fs::remove_all(work.path(), ignored);
    }
}

}  // namespace

double BatchProgress::rate() const {
    const auto now = static_cast<double>(done + failed);
    return seconds > 0.0 ? now / seconds : 0.0;
}

double BatchProgress::seconds_left() const {
    return rate() > 0.0 ? static_cast<double>(all - ended()) / rate() : -1.0;
}

BatchState::BatchState(const BatchPlan& plan)
    : folder_(plan.folder / kBatchFolder), spares_(folder_ / "work"), ledger_(folder_ / "results") {
    for (const auto& [output, record] : ledger_.records()) {
        for (const FileStamp& stamp : record.reads) digests_.know(stamp);
        for (const FileStamp& stamp : record.outputs) digests_.know(stamp);
    }
    program_ = std::string(LISSOM_VERSION) + " " + digests_.stamp(program_file()).digest;
}

std::string BatchState::changed_argument(const BatchJob& job, const JobRecord& record) const {
    const std::map<std::string, std::string> before(record.arguments.begin(),
                                                    record.arguments.end());
    for (const auto& [name, value] : job.arguments) {
        const auto found = before.find(name);
        if (found == before.end()) return name + " is given now";
        if (found->second != value) return name + " was " + found->second;
    }
    return record.arguments.size() != job.arguments.size() ? "an argument is not given any more"
                                                           : "";
}

std::string BatchState::reason_to_run(const BatchJob& job) {
    const JobRecord* const record = this->record(job);
    if (!record) return "new";
    if (!record->is_done()) return record->outcome + " before";
    if (record->program != program_) return "the program has changed";
    if (std::string reason = changed_argument(job, *record); !reason.empty()) return reason;
    for (const FileStamp& stamp : record->reads) {
        if (digests_.stamp(stamp.path).digest != stamp.digest) return stamp.path + " has changed";
    }
    for (const FileStamp& stamp : record->outputs) {
        const FileStamp now = digests_.stamp(stamp.path);
        if (now.digest.empty()) return stamp.path + " is missing";
        if (now.digest != stamp.digest) return stamp.path + " is not as it was written";
    }
    return "";
}

JobRecord refused_record(const BatchJob& job) {
    JobRecord record;
    record.output = job.output.string();
    record.arguments = job.arguments;
    record.outcome = "failed";
    record.status = kFailure;
    record.message = job.refused->message();
    record.result = json_text({{"error", error_json(*job.refused)}}, -1);
    return record;
}

std::unique_ptr<FileLock> lock_batch(const BatchPlan& plan, const BatchState& state, bool shares) {
    for (const char* name : {"results", "logs", "locks", "work", "slurm"}) {
        make_folder(state.folder() / name);
    }
    auto lock = std::make_unique<FileLock>(state.folder() / "lock");
    if (!(shares ? lock->share() : lock->take())) {
        throw Error(ErrorCode::file_write_failed, "another batch works in " +
                                                      display_name(plan.folder) + ": process " +
                                                      first_line(state.folder() / "lock"));
    }
    lock->write(process_name() + "\n");
    if (!shares) remove_abandoned_work(state.folder());
    return lock;
}

BatchProgress run_batch(const BatchPlan& plan, BatchState& state, const BatchOptions& options) {
    const std::unique_ptr<FileLock> lock = lock_batch(plan, state, options.shares_folder);
    const BatchProgress progress = Driver(plan, state, options).run();
    // Processes of a killed batch may have lived until now.
    if (!options.shares_folder) remove_abandoned_work(state.folder());
    return progress;
}

}  // namespace lissom::cli
