#include "bindings/cli/process/time_limit.h"

#include <chrono>

#include "bindings/cli/process/child_process.h"

namespace lissom::cli {

TimeLimit::TimeLimit(double seconds) {
    if (seconds > 0.0) watcher_ = std::thread([this, seconds] { watch(seconds); });
}

TimeLimit::~TimeLimit() {
    stop();
}

bool TimeLimit::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
    }
    changed_.notify_one();
    if (watcher_.joinable()) watcher_.join();
    return over_;
}

void TimeLimit::watch(double seconds) {
    std::unique_lock lock(mutex_);
    const bool stopped =
        changed_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return stopped_; });
    if (stopped) return;
    over_ = true;
    interrupt_program();
}

}  // namespace lissom::cli
