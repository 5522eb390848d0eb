#include "bindings/cli/batch/driver.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <thread>

#include "bindings/cli/batch/durable_files.h"
#include "bindings/cli/batch/job_process.h"
#include "bindings/cli/batch/staging.h"
#include "bindings/cli/json.h"
#include "bindings/cli/process/child_process.h"
#include "bindings/cli/process/process_number.h"
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
constexpr std::size_t kMessageLength = 500;

double seconds_after(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::int64_t milliseconds_since_1970() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

std::string job_key(const BatchJob& job) {
    return text_digest(job.output.string()).substr(0, 16);
}

bool is_full(const fs::path& folder) {
    std::error_code error;
    const fs::space_info space = fs::space(folder, error);
    return !error && space.available < kFullBytes;
}

// A job while it is tried.
class Attempt {
  public:
    Attempt(const BatchPlan& plan, const BatchJob& job, int number, const BatchOptions& options,
            const BatchState& state)
        : plan_(plan),
          job_(job),
          number_(number),
          options_(options),
          folder_(state.folder()),
          lock_(state.folder() / "locks" / job_key(job)) {
        log_ = state.folder() / "logs" / (job_key(job) + "." + std::to_string(number) + ".log");
        is_free_ = lock_.take();
    }
    ~Attempt() {
        // Ends the process before its folder and lock go.
        process_.reset();
    }
    Attempt(const Attempt&) = delete;
    Attempt& operator=(const Attempt&) = delete;

    /// False while a process of an earlier batch still works on the job.
    bool is_free() const { return is_free_; }
    const BatchJob& job() const { return job_; }
    int number() const { return number_; }
    const ChildProcess& process() const { return *process_; }

    void start() {
        std::error_code ignored;
        fs::remove(log_, ignored);
        // A process that outlives its driver keeps its own folder.
        const std::string work = job_key(job_) + "." + std::to_string(process_number());
        staging_.emplace(folder_ / "work" / work, job_.output, plan_.makes_folders);
        const JobTask task{plan_.script, script_words(plan_, job_, staging_->output())};
        start_ = Clock::now();
        process_ = std::make_unique<ChildProcess>(
            std::vector<std::string>{"batch", "--threads", std::to_string(options_.threads),
                                     "--job", task_line(task)},
            log_, lock_.descriptor());
    }

    // Takes the news; returns whether the process has ended.
    bool has_ended() {
        for (const std::string& line : process_->lines()) take(line);
        if (!process_->has_ended() && options_.timeout > 0.0 &&
            seconds_after(start_) > options_.timeout) {
            is_late_ = true;
            process_->kill();
        }
        return process_->has_ended();
    }

    // Moves the outputs of a job that ended well to their place.
    JobRecord conclude(BatchState& state, std::set<fs::path>& folders) {
        JobRecord record = ended_record(state);
        if (record.is_done()) publish(record, state, folders);
        const std::string end = record.is_done() ? "done" : record.outcome + ": " + record.message;
        std::ofstream(log_, std::ios::app) << end << " after " << number_text(record.seconds)
                                           << " s, " << record.memory / (1 << 20) << " MiB\n";
        return record;
    }

  private:
    void take(const std::string& line) {
        try {
            news_ = read_news(line);
        } catch (const nlohmann::json::exception&) {
            news_.message = "the process of the job told nothing that is understood";
        }
    }

    JobRecord ended_record(BatchState& state) {
        const ProcessEnd& end = process_->end();
        JobRecord record;
        record.output = job_.output.string();
        record.arguments = job_.arguments;
        record.status = end.status;
        record.outcome = is_late_                 ? "timed_out"
                         : end.by_signal          ? "crashed"
                         : end.status == kSuccess ? "done"
                                                  : "failed";
        record.message = is_late_ ? "it took longer than " + number_text(options_.timeout) + " s"
                         : end.by_signal ? end.text()
                                         : news_.message.substr(0, kMessageLength);
        record.log = fs::path(log_).lexically_relative(state.folder().parent_path()).string();
        record.attempts = number_;
        record.warnings = news_.warnings;
        record.seconds = std::round(1000.0 * seconds_after(start_)) / 1000.0;
        record.cpu_seconds = std::round(1000.0 * end.cpu_seconds) / 1000.0;
        record.memory = end.memory;
        record.time = milliseconds_since_1970();
        record.program = state.program();
        return record;
    }

    void publish(JobRecord& record, BatchState& state, std::set<fs::path>& folders) {
        try {
            record.reads = read_stamps(state.digests());
            record.outputs = staging_->publish(state.record(job_), state.digests(), folders);
        } catch (const Error& error) {
            record.outcome = "failed";
            record.status = kFailure;
            record.message = error.message();
        }
    }

    // Without the files that the job itself has made.
    std::vector<FileStamp> read_stamps(FileDigests& digests) const {
        std::set<std::string> files(news_.reads.begin(), news_.reads.end());
        for (const fs::path& input : job_.inputs) files.insert(input.string());
        const std::string own = staging_->output().parent_path().string() + "/";
        std::vector<FileStamp> stamps;
        for (const std::string& file : files) {
            if (!file.starts_with(own)) stamps.push_back(digests.stamp(file));
        }
        return stamps;
    }

    const BatchPlan& plan_;
    const BatchJob& job_;
    int number_;
    const BatchOptions& options_;
    fs::path folder_;
    FileLock lock_;
    fs::path log_;
    bool is_free_ = false, is_late_ = false;
    std::optional<Staging> staging_;
    std::unique_ptr<ChildProcess> process_;
    JobNews news_;
    Clock::time_point start_;
};

bool is_tried_again(const JobRecord& record, const BatchOptions& options) {
    const bool was_called_wrongly = record.outcome == "failed" && record.status == kUsage;
    return !record.is_done() && !was_called_wrongly && record.attempts <= options.retries;
}

// What waits: a job and the number of its next attempt.
struct Waiting {
    const BatchJob* job;
    int attempt;
    std::string reason;
};

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
            const std::vector<std::unique_ptr<Attempt>> ended = take_ended();
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
            std::string reason = state_.reason_to_run(job);
            if (reason.empty()) {
                ++progress_.kept;
            } else {
                waiting_.push_back({&job, 1, std::move(reason)});
            }
        }
    }

    void start_jobs() {
        const auto most = static_cast<std::size_t>(options_.jobs);
        for (std::size_t tries = waiting_.size(); tries > 0 && running_.size() < most; --tries) {
            Waiting next = std::move(waiting_.front());
            waiting_.pop_front();
            auto attempt =
                std::make_unique<Attempt>(plan_, *next.job, next.attempt, options_, state_);
            if (!attempt->is_free()) {
                waiting_.push_back(std::move(next));
                continue;
            }
            if (options_.shares_folder && next.attempt == 1 && is_done_elsewhere(*next.job)) {
                ++progress_.kept;
                continue;
            }
            attempt->start();
            if (options_.started) options_.started(*next.job, next.reason);
            running_.push_back(std::move(attempt));
        }
    }

    // To be asked with the lock of the job, which another process may have had.
    bool is_done_elsewhere(const BatchJob& job) {
        state_.refresh();
        return state_.reason_to_run(job).empty();
    }

    void wait() const {
        std::vector<const ChildProcess*> processes;
        for (const auto& attempt : running_) processes.push_back(&attempt->process());
        ChildProcess::wait(processes, kWaitSeconds);
    }

    std::vector<std::unique_ptr<Attempt>> take_ended() {
        std::vector<std::unique_ptr<Attempt>> ended;
        for (auto& attempt : running_) {
            if (attempt->has_ended()) ended.push_back(std::move(attempt));
        }
        std::erase(running_, nullptr);
        return ended;
    }

    // All at once, as the disk takes as long for one as for several.
    void conclude(const std::vector<std::unique_ptr<Attempt>>& ended) {
        if (ended.empty()) return;
        std::set<fs::path> folders;
        std::vector<JobRecord> records;
        for (const auto& attempt : ended) records.push_back(attempt->conclude(state_, folders));
        require_space(records);
        for (const fs::path& folder : folders) flush_to_disk(folder);
        state_.add(records);
        for (std::size_t i = 0; i < ended.size(); ++i) settle(ended[i]->job(), records[i]);
    }

    void require_space(const std::vector<JobRecord>& records) const {
        const bool all_done = std::all_of(records.begin(), records.end(),
                                          [](const JobRecord& record) { return record.is_done(); });
        if (all_done || !is_full(state_.folder())) return;
        throw Error(ErrorCode::file_write_failed,
                    "the disk of " + display_name(plan_.folder) +
                        " is full: free space, and start the batch again; it goes on from here");
    }

    void settle(const BatchJob& job, const JobRecord& record) {
        if (is_tried_again(record, options_)) {
            waiting_.push_back({&job, record.attempts + 1, record.outcome});
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
    std::deque<Waiting> waiting_;
    std::vector<std::unique_ptr<Attempt>> running_;
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
        FileLock lock(folder / "locks" / work.path().stem());
        std::error_code ignored;
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
    : folder_(plan.folder / kBatchFolder), ledger_(folder_ / "results") {
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
    return Driver(plan, state, options).run();
}

}  // namespace lissom::cli
