/// FrameTimes: how long the thread of a window was away, and how far pictures are behind the hand.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kernel/core/clock.h"

namespace lissom::window {

/// Seconds that this thread has had a processor for, which other programs do not change.
double thread_seconds();

/// Time that a thread was busy, without the calls that draw.
struct Turn {
    /// That have passed, and in which the thread had a processor.
    double seconds = 0.0, busy = 0.0;
};

class FrameTimes {
  public:
    using Time = Clock::time_point;

    /// Between two waits for events the thread was away for `all`, without calls that draw `own`.
    void add_turn(double all, const Turn& own);
    /// Something was done by a hand at `time`, or shortly after.
    void add_event(Time time);
    /// The work until now has changed nothing visible.
    void end_event() { waiting_.reset(); }
    /// The change was drawn and shown at `time`.
    void add_frame(Time time);

    double longest() const { return longest_; }
    /// Without calls that draw: the longest by the clock, and that with most work.
    double longest_own() const { return longest_own_; }
    double max_work() const { return max_work_; }
    /// Seconds from an event to the frame that answers it; `part` 0.5 is the median. 0 for none.
    double latency(double part) const;
    /// Frames in a second while they follow each other within half a second.
    double rate() const;
    /// "longest 31 ms, without drawing 5 ms, work 4 ms, event to frame 20 ms, 95 % 40 ms, 25.0
    /// frames a second"
    std::string text() const;

  private:
    double longest_ = 0.0, longest_own_ = 0.0, max_work_ = 0.0;
    std::optional<Time> waiting_, last_frame_;
    std::vector<double> latencies_, intervals_;
};

}  // namespace lissom::window
