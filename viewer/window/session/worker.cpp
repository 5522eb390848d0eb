#include "viewer/window/session/worker.h"

#include <chrono>
#include <utility>

#include "kernel/core/index.h"

namespace lissom::window {

Worker::Worker() : thread_([this] { run(); }) {}

Worker::~Worker() {
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
        open_ -= count_of(jobs_);
        jobs_.clear();
    }
    changed_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void Worker::post(Job job, bool stays) {
    {
        const std::lock_guard lock(mutex_);
        jobs_.push_back({std::move(job), stays});
        ++open_;
    }
    changed_.notify_all();
}

void Worker::post_only(Job job) {
    {
        const std::lock_guard lock(mutex_);
        const auto dropped = std::erase_if(jobs_, [](const Waiting& one) { return !one.stays; });
        open_ -= index_of(dropped);
        jobs_.push_back({std::move(job)});
        ++open_;
    }
    changed_.notify_all();
}

bool Worker::wait_idle(double seconds) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                             [this] { return open_ == 0; });
}

void Worker::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return ended_ || !jobs_.empty(); });
        if (ended_) return;
        const Job job = std::move(jobs_.front().job);
        jobs_.pop_front();
        lock.unlock();
        job();
        lock.lock();
        --open_;
        changed_.notify_all();
    }
}

}  // namespace lissom::window
