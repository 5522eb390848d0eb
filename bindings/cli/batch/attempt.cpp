#include "bindings/cli/batch/attempt.h"

#include <cmath>
#include <fstream>
#include <utility>

#include "bindings/cli/batch/files/companions.h"
#include "bindings/cli/json.h"
#include "bindings/cli/process/process_number.h"
#include "kernel/core/error.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMessageLength = 500;

std::int64_t milliseconds_since_1970() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

std::string job_key(const BatchJob& job) {
    return text_digest(job.output.string()).substr(0, 16);
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
        text.replace(at, from.size(), to);
    }
}

// A path as it stands within a text of JSON; most are as they are.
std::string json_words(const fs::path& path) {
    const std::string text = json_text(path.string(), -1);
    return text.substr(1, text.size() - 2);
}

double rounded_seconds(double seconds) {
    return std::round(1000.0 * seconds) / 1000.0;
}

}  // namespace

Attempt::Attempt(const BatchPlan& plan, WaitingJob waiting, BatchState& state)
    : plan_(plan),
      spares_(state.spares()),
      waiting_(std::move(waiting)),
      folder_(state.folder()),
      lock_(folder_ / "locks" / job_key(job())),
      log_(folder_ / "logs" / (job_key(job()) + "." + std::to_string(waiting_.attempt) + ".log")) {
    is_free_ = lock_.take();
}

double Attempt::seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

JobTask Attempt::prepare() {
    std::error_code ignored;
    fs::remove(log_, ignored);
    // A process that outlives its driver keeps its own folder.
    const std::string work = job_key(job()) + "." + std::to_string(process_number());
    staging_.emplace(folder_ / "work" / work, job().output, plan_.makes_folders, spares_);
    staging_->hold(waiting_.taken);
    return {plan_.script, job_words(plan_, job(), staging_->output()), log_.string()};
}

std::set<fs::path> Attempt::taken() const {
    std::set<fs::path> names = staging_->taken();
    if (!names.empty()) names.insert(waiting_.taken.begin(), waiting_.taken.end());
    return names;
}

void Attempt::end(const ProcessEnd& end, double timeout) {
    end_ = end;
    timeout_ = timeout;
    seconds_ = seconds();
}

JobRecord Attempt::conclude(BatchState& state, std::set<fs::path>& folders) {
    JobRecord record = ended_record(state);
    if (record.is_done()) publish(record, state, folders);
    const std::string end = record.is_done() ? "done" : record.outcome + ": " + record.message;
    std::ofstream(log_, std::ios::app) << end << " after " << number_text(record.seconds) << " s, "
                                       << record.memory / (1 << 20) << " MiB\n";
    return record;
}

JobRecord Attempt::ended_record(const BatchState& state) const {
    const bool is_late = timeout_ > 0.0;
    JobRecord record;
    record.output = job().output.string();
    record.arguments = job().arguments;
    record.status = end_.status;
    record.outcome = is_late                   ? "timed_out"
                     : end_.by_signal          ? "crashed"
                     : end_.status == kSuccess ? "done"
                                               : "failed";
    record.message = is_late          ? "it took longer than " + number_text(timeout_) + " s"
                     : end_.by_signal ? end_.text()
                                      : with_place(news_.message).substr(0, kMessageLength);
    if (!is_late && !end_.by_signal) record.result = with_place(news_.result);
    record.log = log_.lexically_relative(folder_.parent_path()).string();
    record.attempts = waiting_.attempt;
    record.warnings = news_.warnings;
    record.seconds = rounded_seconds(seconds_);
    record.cpu_seconds = rounded_seconds(end_.cpu_seconds);
    record.memory = end_.memory;
    record.time = milliseconds_since_1970();
    record.program = state.program();
    return record;
}

// The text with the place of the output instead of that in the work folder.
std::string Attempt::with_place(std::string text) const {
    const fs::path work = staging_->output();
    replace_all(text, work.string(), job().output.string());
    replace_all(text, json_words(work), json_words(job().output));
    return text;
}

void Attempt::publish(JobRecord& record, BatchState& state, std::set<fs::path>& folders) {
    try {
        record.reads = read_stamps(state.digests());
        record.outputs = staging_->publish(state.record(job()), state.digests(), folders);
    } catch (const Error& error) {
        record.outcome = "failed";
        record.status = kFailure;
        record.message = error.message();
    }
}

// Without the files that the job itself has made.
std::vector<FileStamp> Attempt::read_stamps(FileDigests& digests) const {
    std::set<std::string> files(news_.reads.begin(), news_.reads.end());
    for (const fs::path& input : job().inputs) files.insert(input.string());
    for (const std::string& file : std::set<std::string>(files)) add_companions(file, files);
    const std::string own = staging_->output().parent_path().string() + "/";
    std::vector<FileStamp> stamps;
    for (const std::string& file : files) {
        if (!file.starts_with(own)) stamps.push_back(digests.stamp(file));
    }
    return stamps;
}

}  // namespace lissom::cli
