#include "bindings/cli/test/runner.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>
#include <optional>
#include <random>

#include "bindings/cli/json.h"
#include "bindings/cli/process/child_process.h"
#include "bindings/cli/test/worker.h"

namespace lissom::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Time of a process beyond the limit of a test, to stop by itself before it is killed.
constexpr double kGrace = 5.0;

double seconds_between(Clock::time_point start, Clock::time_point end) {
    return std::chrono::duration<double>(end - start).count();
}

// A new folder for files of the run.
fs::path make_run_folder() {
    std::random_device random;
    for (int tries = 0; tries < 100; ++tries) {
        const fs::path folder =
            fs::temp_directory_path() / ("lissom-test-" + std::to_string(random()));
        if (fs::create_directories(folder)) return folder;
    }
    throw std::runtime_error("no folder for the files of tests can be made in " +
                             fs::temp_directory_path().string());
}

std::string text_of(const fs::path& file, std::uintmax_t from, std::uintmax_t to) {
    constexpr std::uintmax_t kMost = 64 * 1024;
    std::ifstream stream(file, std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(from));
    std::string text(std::min(to - std::min(from, to), kMost), '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, stream.gcount())));
    if (to - from > kMost) text += "\n... (" + std::to_string(to - from) + " bytes in all)\n";
    return text;
}

TestStatus status_of(const std::string& text) {
    return text == "passed"    ? TestStatus::passed
           : text == "skipped" ? TestStatus::skipped
                               : TestStatus::failed;
}

// Returns the calls above the failing one, without repetitions of it.
std::vector<TestLine> callers_of(const Json& event, const TestLine& place) {
    std::vector<TestLine> callers;
    for (const Json& call : event.value("calls", Json::array())) {
        TestLine line = {call.at("file"), call.at("line")};
        const bool is_place = line.file == place.file && line.line == place.line;
        if (callers.size() < 6 && !is_place) callers.push_back(std::move(line));
    }
    return callers;
}

// One file while it is run.
class FileRun {
  public:
    FileRun(const fs::path& file, const fs::path& folder, int number, const RunnerOptions& options)
        : options_(options) {
        const fs::path own = folder / (std::to_string(number) + "-" + file.stem().string());
        job_.file = fs::absolute(file).lexically_normal();
        job_.shown = file.string();
        job_.output = own.string() + ".output";
        job_.folder = own;
        job_.filter = options.filter;
        job_.list = options.list;
        job_.update = options.update;
        job_.seed = options.seed;
        job_.timeout = options.timeout;
        result_.file = job_.shown;
    }

    // One that is stopped leaves nothing behind.
    ~FileRun() {
        if (has_ended_ || !has_started()) return;
        process_.reset();
        std::error_code error;
        if (running_) fs::remove_all(running_->folder, error);
        remove_files();
    }
    FileRun(const FileRun&) = delete;
    FileRun& operator=(const FileRun&) = delete;

    bool has_started() const { return process_ != nullptr; }
    bool has_ended() const { return has_ended_; }
    const FileResult& result() const { return result_; }
    const ChildProcess* process() const { return process_.get(); }

    void start() {
        if (!has_started()) began_ = Clock::now();
        is_done_ = false;
        process_ = std::make_unique<ChildProcess>(
            std::vector<std::string>{"test", "--threads", std::to_string(options_.threads), "--job",
                                     json_text(job_json(job_), -1)},
            job_.output);
        set_deadline(options_.timeout);
    }

    // Handles the messages of the process, and continues if it has ended.
    void proceed() {
        for (const std::string& line : process_->lines()) take(Json::parse(line));
        if (process_->has_ended()) {
            conclude();
        } else if (deadline_ && Clock::now() > *deadline_) {
            is_late_ = true;
            process_->kill();
        }
    }

  private:
    void set_deadline(double seconds) {
        deadline_.reset();
        if (seconds <= 0.0) return;
        deadline_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                       std::chrono::duration<double>(seconds + kGrace));
    }

    void take(const Json& event);
    void begin(const Json& event);
    void end(TestResult test, const Json& event);
    void conclude();
    void fail_running();
    void fail_file(std::string message);
    void finish();
    void remove_files();

    const RunnerOptions& options_;
    TestJob job_;
    std::unique_ptr<ChildProcess> process_;
    FileResult result_;
    // The running test, and the begin of its output.
    std::optional<TestResult> running_;
    std::uintmax_t output_from_ = 0;
    Clock::time_point began_, test_began_;
    std::optional<Clock::time_point> deadline_;
    bool is_late_ = false, is_done_ = false, has_ended_ = false;
};

void FileRun::take(const Json& event) {
    const std::string kind = event.at("event");
    if (kind == "limit") {
        set_deadline(event.at("seconds"));
    } else if (kind == "begin") {
        begin(event);
    } else if (kind == "left_out" && running_) {
        running_->left_out.push_back(event.at("text"));
    } else if (kind == "updated" && running_) {
        running_->updated.push_back(event.at("path"));
    } else if (kind == "end" && running_) {
        ++job_.finished;
        end(*std::move(running_), event);
        running_.reset();
    } else if (kind == "test") {
        TestResult& listed = result_.tests.emplace_back();
        listed.name = event.at("name");
        listed.line = event.at("line");
    } else if (kind == "file") {
        TestResult file;
        file.line = 1;
        end(std::move(file), event);
    } else if (kind == "done") {
        is_done_ = true;
    }
}

void FileRun::begin(const Json& event) {
    running_.emplace();
    running_->name = event.at("name");
    running_->line = event.at("line");
    running_->folder = event.at("folder");
    test_began_ = Clock::now();
    output_from_ = event.at("output");
}

void FileRun::end(TestResult test, const Json& event) {
    test.status = status_of(event.at("status"));
    test.seconds = event.value("seconds", 0.0);
    test.message = event.value("message", "");
    test.place = {event.value("file", job_.shown), event.value("line", test.line)};
    test.is_expectation = event.value("expectation", false);
    test.callers = callers_of(event, test.place);
    test.folder = event.value("folder", "");
    test.output = text_of(job_.output, output_from_, event.at("output"));
    output_from_ = event.at("output");
    result_.tests.push_back(std::move(test));
}

// The process has ended.
void FileRun::conclude() {
    if (running_) {
        fail_running();
        start();
        return;
    }
    const std::string how = process_->end().text();
    const bool ended_well = !process_->end().by_signal && process_->end().status == 0;
    if (is_late_) {
        fail_file("loading the file took longer than " + seconds_text(options_.timeout) +
                  " and could not be stopped");
    } else if (!is_done_) {
        fail_file("the process ended with " + how + " outside of its tests");
    } else if (!ended_well && result_.tests.empty()) {
        fail_file("the process ended with " + how);
    } else if (!ended_well && process_->end().by_signal) {
        fail_file("the process ended with " + how + " after its tests");
    }
    finish();
}

// The process ended within a test: another one runs those behind it.
void FileRun::fail_running() {
    TestResult test = *std::move(running_);
    running_.reset();
    test.status = TestStatus::failed;
    test.seconds = seconds_between(test_began_, Clock::now());
    test.place = {job_.shown, test.line};
    const ProcessEnd& end = process_->end();
    test.message = is_late_ ? "it took too long, and could not be stopped within " +
                                  seconds_text(kGrace) + " after its time limit"
                   : end.by_signal ? "the process crashed: " + end.text()
                                   : "the process ended with " + end.text() +
                                         " before the test did: os.exit, or a library";
    std::error_code error;
    const std::uintmax_t size = fs::file_size(job_.output, error);
    test.output = text_of(job_.output, output_from_, error ? output_from_ : size);
    output_from_ = error ? output_from_ : size;
    if (!fs::exists(test.folder, error)) test.folder.clear();
    result_.tests.push_back(std::move(test));
    ++job_.finished;
    is_late_ = false;
}

void FileRun::fail_file(std::string message) {
    TestResult test;
    test.status = TestStatus::failed;
    test.message = std::move(message);
    test.place = {job_.shown, 1};
    std::error_code error;
    const std::uintmax_t size = fs::file_size(job_.output, error);
    test.output = text_of(job_.output, output_from_, error ? output_from_ : size);
    result_.tests.push_back(std::move(test));
}

void FileRun::finish() {
    result_.seconds = seconds_between(began_, Clock::now());
    has_ended_ = true;
    remove_files();
}

void FileRun::remove_files() {
    std::error_code error;
    fs::remove(job_.output, error);
    if (fs::is_empty(job_.folder, error)) fs::remove(job_.folder, error);
}

class Runner {
  public:
    Runner(const std::vector<fs::path>& files, const fs::path& folder, const RunnerOptions& options)
        : options_(options) {
        for (std::size_t i = 0; i < files.size(); ++i) {
            runs_.push_back(
                std::make_unique<FileRun>(files[i], folder, static_cast<int>(i) + 1, options));
        }
    }

    void run() {
        while (taken_ < runs_.size()) {
            if (options_.stopped && options_.stopped()) return;
            start_more();
            std::vector<const ChildProcess*> processes;
            for (const FileRun* run : active_) processes.push_back(run->process());
            ChildProcess::wait(processes, 0.1);
            for (FileRun* run : active_) run->proceed();
            std::erase_if(active_, [](const FileRun* run) { return run->has_ended(); });
            if (options_.progress) options_.progress(next_ - active_.size());
            hand_on();
        }
    }

  private:
    void start_more() {
        while (next_ < runs_.size() && active_.size() < static_cast<std::size_t>(options_.jobs)) {
            active_.push_back(runs_[next_++].get());
            active_.back()->start();
        }
    }

    void hand_on() {
        while (taken_ < runs_.size() && runs_[taken_]->has_ended()) {
            options_.take(runs_[taken_]->result());
            runs_[taken_++].reset();
        }
    }

    const RunnerOptions& options_;
    std::vector<std::unique_ptr<FileRun>> runs_;
    std::vector<FileRun*> active_;
    // The next to start, and the next whose results are handed on.
    std::size_t next_ = 0, taken_ = 0;
};

}  // namespace

fs::path run_test_files(const std::vector<fs::path>& files, const RunnerOptions& options) {
    const fs::path folder = make_run_folder();
    Runner(files, folder, options).run();
    std::error_code error;
    if (!fs::is_empty(folder, error)) return folder;
    fs::remove(folder, error);
    return {};
}

}  // namespace lissom::cli
