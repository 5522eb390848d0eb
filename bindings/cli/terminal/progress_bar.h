/// A line that shows the progress of long work on a terminal and goes when the work is done.
#pragma once

#include <chrono>
#include <functional>
#include <ostream>
#include <string_view>

namespace lissom::cli {

class ProgressBar {
  public:
    using Clock = std::chrono::steady_clock;

    /// Work shorter than this shows nothing; later the line changes at most this often.
    static constexpr std::chrono::milliseconds kPatience{500}, kInterval{100};

    /// `now` is the clock; tests bring their own.
    explicit ProgressBar(std::ostream& out, std::function<Clock::time_point()> now = Clock::now);

    /// Shows that `fraction` (0 to 1) of the work called `label` is done.
    void show(std::string_view label, double fraction);
    /// Takes the line away: the work has ended.
    void clear();

  private:
    std::ostream& out_;
    std::function<Clock::time_point()> now_;
    Clock::time_point begin_, shown_;
    bool working_ = false, visible_ = false;
};

}  // namespace lissom::cli
