// How long the window was away, and how far its pictures were behind the hand.
#include "viewer/window/screen/frame_times.h"

#include <doctest/doctest.h>

using namespace lissom::window;

TEST_CASE("frame times: the longest turn, events and frames") {
    FrameTimes times;
    const auto at = [](int milliseconds) {
        return FrameTimes::Time() + std::chrono::milliseconds(milliseconds);
    };
    times.add_turn(0.030, {0.001, 0.001});
    times.add_turn(0.020, {0.010, 0.002});
    CHECK(times.longest() == 0.030);
    CHECK(times.longest_own() == 0.010);
    CHECK(times.max_work() == 0.002);
    CHECK(times.latency(0.95) == 0.0);
    CHECK(times.rate() == 0.0);
    CHECK(thread_seconds() >= 0.0);
    // Of events that wait together the first counts; a frame without one counts for the rate alone.
    times.add_event(at(100));
    times.add_event(at(130));
    times.add_frame(at(150));
    times.add_frame(at(200));
    times.add_event(at(240));
    times.add_frame(at(250));
    times.add_event(at(5000));
    times.add_frame(at(5020));
    CHECK(times.latency(0.5) == doctest::Approx(0.020));
    CHECK(times.latency(0.95) == doctest::Approx(0.050));
    CHECK(times.rate() == doctest::Approx(20.0));
    CHECK(
        times.text() ==
        "longest 30.0 ms, without drawing 10.0 ms, work 2.0 ms, event to frame 20.0 ms, 95 % 50.0 "
        "ms, 20.0 frames a second");
}
