/// Worker: one thread that does one job after the other, away from the thread that asked for them.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace lissom::window {

class Worker {
  public:
    using Job = std::function<void()>;

    Worker();
    /// Drops waiting jobs and joins; cancel the running job before to end it soon.
    ~Worker();
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    /// Does `job` after all others. It must not throw. If it `stays`, `post_only` leaves it
    /// waiting.
    void post(Job job, bool stays = false);
    /// The same instead of all others that wait and do not stay.
    void post_only(Job job);
    /// Returns whether a job runs or waits.
    bool busy() const { return open_ > 0; }
    /// Waits until nothing runs, `seconds` at most; whether that is so.
    bool wait_idle(double seconds);

  private:
    void run();

    std::mutex mutex_;
    std::condition_variable changed_;
    struct Waiting {
        Job job;
        bool stays = false;
    };
    std::deque<Waiting> jobs_;
    std::atomic<int> open_{0};
    bool ended_ = false;
    std::thread thread_;
};

}  // namespace lissom::window
