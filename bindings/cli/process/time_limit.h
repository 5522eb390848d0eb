/// A limit of the time that a call may take.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

namespace lissom::cli {

/// Interrupts running work as Ctrl-C does (see Interrupt) if it takes longer than `seconds`, unless
/// the object is destroyed before; 0: never.
class TimeLimit {
  public:
    explicit TimeLimit(double seconds);
    ~TimeLimit();
    TimeLimit(const TimeLimit&) = delete;
    TimeLimit& operator=(const TimeLimit&) = delete;

    /// Ends the watch. Returns whether the time was over before.
    bool stop();

  private:
    void watch(double seconds);

    std::mutex mutex_;
    std::condition_variable changed_;
    bool stopped_ = false, over_ = false;
    std::thread watcher_;
};

}  // namespace lissom::cli
