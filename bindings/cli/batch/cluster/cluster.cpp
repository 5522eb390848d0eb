#include "bindings/cli/batch/cluster/cluster.h"

#include <chrono>
#include <optional>
#include <thread>

#include "bindings/cli/batch/cluster/slurm.h"
#include "bindings/cli/json.h"
#include "kernel/core/error.h"
#include "kernel/io/stream/file.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kLookSeconds = 1.0, kAskSeconds = 8.0;

std::int64_t now_in_milliseconds() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

// Mean seconds of the jobs that were done, 0 if there are none.
double mean_seconds(const BatchPlan& plan, const BatchState& state) {
    double sum = 0.0, count = 0.0;
    for (const BatchJob& job : plan.jobs) {
        const JobRecord* const record = state.record(job);
        if (!record || !record->is_done()) continue;
        sum += record->seconds;
        ++count;
    }
    return count > 0.0 ? sum / count : 0.0;
}

fs::path submission_file(const BatchState& state) {
    return fs::absolute(state.folder() / "slurm" / "submission.json");
}
fs::path array_file(const BatchState& state) {
    return state.folder() / "slurm" / "array.json";
}

// The array that was submitted last and has not ended, as far as Slurm tells.
std::optional<SlurmArray> running_array(const BatchState& state) {
    std::error_code error;
    if (!fs::exists(array_file(state), error)) return {};
    const Json json = Json::parse(read_file(array_file(state)).bytes, nullptr, false);
    if (!json.is_object()) return {};
    const SlurmArray array{json.value("id", ""), json.value("name", "")};
    if (slurm_state(array) != SlurmState::waits_or_runs) return {};
    return array;
}

// Jobs that were not done when the watch began, and how they stand.
class Watch {
  public:
    Watch(const BatchPlan& plan, BatchState& state, const BatchOptions& options, std::int64_t since)
        : plan_(plan), state_(state), options_(options), since_(since) {
        progress_.all = plan.jobs.size();
        for (const BatchJob& job : plan.jobs) {
            if (job.refused) {
                ++refused_;
            } else if (state.reason_to_run(job).empty()) {
                ++progress_.kept;
            } else {
                watched_.push_back(&job);
            }
        }
    }

    void look() {
        state_.refresh();
        progress_.done = 0;
        progress_.failed = refused_;
        for (const BatchJob* job : watched_) {
            const JobRecord* const record = state_.record(*job);
            if (!record || record->time < since_) continue;
            progress_.done += record->is_done();
            progress_.failed += !record->is_done() && record->attempts > options_.retries;
        }
        progress_.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
        if (options_.progress) options_.progress(progress_);
    }

    const BatchProgress& progress() const { return progress_; }

  private:
    const BatchPlan& plan_;
    BatchState& state_;
    const BatchOptions& options_;
    std::int64_t since_;
    std::vector<const BatchJob*> watched_;
    std::size_t refused_ = 0;
    BatchProgress progress_;
    Clock::time_point start_ = Clock::now();
};

BatchProgress watch(const BatchPlan& plan, BatchState& state, const BatchOptions& options,
                    const SlurmArray& array, std::int64_t since) {
    Watch watch(plan, state, options, since);
    Clock::time_point asked = Clock::now();
    // A task that is requeued is not in the queue for a moment: it has ended if that is said twice.
    for (int ended = 0; !options.stopped();) {
        watch.look();
        if (ended == 2 || watch.progress().ended() == watch.progress().all) break;
        std::this_thread::sleep_for(std::chrono::duration<double>(kLookSeconds));
        if (std::chrono::duration<double>(Clock::now() - asked).count() < kAskSeconds) continue;
        ended = slurm_state(array) == SlurmState::ended ? ended + 1 : 0;
        asked = Clock::now();
    }
    const BatchProgress& progress = watch.progress();
    if (progress.kept + progress.done == progress.all) cancel(array);
    return progress;
}

BatchPlan plan_of_task(const Submission& submission, std::size_t task) {
    const BatchPlan& all = submission.plan;
    BatchPlan plan = {all.script, all.verb, all.out_parameter, all.makes_folders, all.folder, {}};
    for (const std::size_t job : submission.tasks[task]) {
        plan.jobs.push_back(submission.plan.jobs.at(job));
    }
    return plan;
}

// Takes on jobs of the tasks that follow until this one has lasted its time: they may be shorter
// than was thought, and a task costs more than they do.
void help_other_tasks(const Submission& submission, std::size_t task, Clock::time_point start,
                      BatchState& state, BatchOptions options) {
    options.leaves_taken = true;
    const std::size_t count = submission.tasks.size();
    for (std::size_t i = 1; i < count; ++i) {
        const std::chrono::duration<double> lasted = Clock::now() - start;
        if (options.stopped() || lasted.count() > kTaskSeconds) return;
        BatchPlan plan = plan_of_task(submission, (task + i) % count);
        state.refresh();
        std::erase_if(plan.jobs, [&](const BatchJob& job) {
            const JobRecord* const record = state.record(job);
            return record && record->time >= submission.time;
        });
        if (!plan.jobs.empty()) run_batch(plan, state, options);
    }
}

}  // namespace

Submission make_submission(const BatchPlan& plan, BatchState& state, const BatchOptions& options,
                           std::size_t max_tasks) {
    const std::unique_ptr<FileLock> lock = lock_batch(plan, state, false);
    Submission submission;
    submission.plan = plan;
    submission.options = options;
    submission.directory = fs::current_path();
    submission.time = now_in_milliseconds();
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < plan.jobs.size(); ++i) {
        const BatchJob& job = plan.jobs[i];
        if (!job.refused && !state.reason_to_run(job).empty()) open.push_back(i);
    }
    submission.tasks = divide(open, mean_seconds(plan, state), options.jobs, max_tasks);
    return submission;
}

BatchProgress run_on_slurm(const BatchPlan& plan, BatchState& state, const BatchOptions& options,
                           const std::vector<std::string>& more) {
    if (const std::optional<SlurmArray> before = running_array(state)) {
        return watch(plan, state, options, *before, 0);
    }
    const std::int64_t since = now_in_milliseconds();
    const Submission submission = make_submission(plan, state, options, max_tasks());
    if (submission.tasks.empty()) return watch(plan, state, options, {}, since);
    write_submission(submission, submission_file(state));
    const SlurmArray array = submit(submission, submission_file(state), more);
    write_file_atomically(array_file(state),
                          json_text({{"id", array.id}, {"name", array.name}}) + "\n");
    return watch(plan, state, options, array, since);
}

std::vector<std::string> export_to_slurm(const BatchPlan& plan, BatchState& state,
                                         const BatchOptions& options, const fs::path& script,
                                         const std::vector<std::string>& more) {
    const Submission submission = make_submission(plan, state, options, max_tasks());
    const fs::path file = submission_file(state);
    write_submission(submission, file);
    write_file_atomically(script, task_script(file));
    return sbatch_words(submission, "lissom", file.parent_path(), script, more);
}

BatchProgress run_task(const Submission& submission, std::size_t task, BatchOptions options) {
    if (task >= submission.tasks.size()) {
        throw Error(ErrorCode::out_of_range, "the submission has " +
                                                 std::to_string(submission.tasks.size()) +
                                                 " tasks, not task " + std::to_string(task));
    }
    const Clock::time_point start = Clock::now();
    fs::current_path(submission.directory);
    const BatchPlan plan = plan_of_task(submission, task);
    BatchState state(plan);
    options.shares_folder = true;
    const BatchProgress progress = run_batch(plan, state, options);
    help_other_tasks(submission, task, start, state, options);
    return progress;
}

}  // namespace lissom::cli
