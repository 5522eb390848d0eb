#include "bindings/cli/batch/job_pack.h"

#include <utility>

#include "bindings/cli/json.h"

namespace lissom::cli {

JobPack::JobPack(Attempts attempts, const BatchOptions& options)
    : attempts_(std::move(attempts)), timeout_(options.timeout) {
    std::vector<JobTask> tasks;
    std::vector<int> locks;
    for (const auto& attempt : attempts_) {
        tasks.push_back(attempt->prepare());
        locks.push_back(attempt->lock());
    }
    attempts_.front()->begin();
    process_ = std::make_unique<ChildProcess>(
        std::vector<std::string>{"batch", "--threads", std::to_string(options.threads), "--job",
                                 tasks_line(tasks)},
        attempts_.front()->log(), locks);
}

Attempts JobPack::take_ended() {
    Attempts ended;
    for (const std::string& line : process_->lines()) take(line, ended);
    kill_if_late();
    if (has_ended() && current_ < attempts_.size()) end_current(process_->end(), ended);
    return ended;
}

Attempts JobPack::take_others() {
    Attempts others;
    for (auto& attempt : attempts_) {
        if (attempt) others.push_back(std::move(attempt));
    }
    return others;
}

void JobPack::take(const std::string& line, Attempts& ended) {
    if (current_ >= attempts_.size()) return;
    JobNews news;
    try {
        news = read_news(line);
    } catch (const nlohmann::json::exception&) {
        news.status = kFailure;
        news.message = "the process of the job told nothing that is understood";
    }
    const ProcessEnd end{news.status, false, news.cpu_seconds, news.memory};
    attempts_[current_]->take(std::move(news));
    if (!is_alone()) end_current(end, ended);
}

void JobPack::end_current(const ProcessEnd& end, Attempts& ended) {
    attempts_[current_]->end(end, is_late_ ? timeout_ : 0.0);
    is_late_ = false;
    ended.push_back(std::move(attempts_[current_]));
    if (++current_ < attempts_.size()) attempts_[current_]->begin();
}

void JobPack::kill_if_late() {
    if (timeout_ <= 0.0 || has_ended() || current_ >= attempts_.size()) return;
    if (attempts_[current_]->seconds() <= timeout_) return;
    is_late_ = true;
    process_->kill();
}

}  // namespace lissom::cli
