#include "viewer/window/screen/frame_times.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numeric>

namespace lissom::window {
namespace {

// Seconds without a frame after which nothing moves.
constexpr double kPause = 0.5;

double seconds_between(FrameTimes::Time from, FrameTimes::Time to) {
    return std::chrono::duration<double>(to - from).count();
}

}  // namespace

double thread_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void FrameTimes::add_turn(double all, const Turn& own) {
    longest_ = std::max(longest_, all);
    longest_own_ = std::max(longest_own_, own.seconds);
    max_work_ = std::max(max_work_, own.busy);
}

void FrameTimes::add_event(Time time) {
    if (!waiting_) waiting_ = time;
}

void FrameTimes::add_frame(Time time) {
    if (waiting_) latencies_.push_back(seconds_between(*waiting_, time));
    const double interval = last_frame_ ? seconds_between(*last_frame_, time) : 2.0 * kPause;
    if (interval < kPause) intervals_.push_back(interval);
    waiting_.reset();
    last_frame_ = time;
}

double FrameTimes::latency(double part) const {
    if (latencies_.empty()) return 0.0;
    std::vector<double> sorted = latencies_;
    std::sort(sorted.begin(), sorted.end());
    const double place = std::ceil(part * static_cast<double>(sorted.size())) - 1.0;
    return sorted[static_cast<std::size_t>(std::max(place, 0.0))];
}

double FrameTimes::rate() const {
    const double all = std::accumulate(intervals_.begin(), intervals_.end(), 0.0);
    return all > 0.0 ? static_cast<double>(intervals_.size()) / all : 0.0;
}

std::string FrameTimes::text() const {
    char text[192];
    std::snprintf(text, sizeof text,
                  "longest %.1f ms, without drawing %.1f ms, work %.1f ms, event to frame %.1f ms, "
                  "95 %% %.1f ms, %.1f "
                  "frames a second",
                  1e3 * longest_, 1e3 * longest_own_, 1e3 * max_work_, 1e3 * latency(0.5),
                  1e3 * latency(0.95), rate());
    return text;
}

}  // namespace lissom::window
