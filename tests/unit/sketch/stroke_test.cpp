#include "kernel/sketch/stroke.h"

#include <limits>

#include "tests/unit/sketch/hand.h"

using namespace lissom;
using doctest::Approx;
using test::Hand;

namespace {

// 400 to 500 pixels in one bow and a half.
std::vector<Vec2> bow(Hand& hand) {
    const double height = hand.uniform(40.0, 90.0), turn = hand.uniform(0.0, 2.0 * kPi);
    std::vector<Vec2> points;
    for (int i = 0; i <= 200; ++i) {
        const double x = 2.0 * i, y = height * std::sin(0.012 * x);
        points.emplace_back(500.0 + std::cos(turn) * x - std::sin(turn) * y,
                            500.0 + std::sin(turn) * x + std::cos(turn) * y);
    }
    return points;
}

// Two arms of 200 pixels that turn by an angle.
std::vector<Vec2> angle(Hand& hand, double degrees) {
    const double first = hand.uniform(0.0, 2.0 * kPi), second = first + degrees * kPi / 180.0;
    const Vec2 corner(500, 500);
    return {corner - 200.0 * Vec2(std::cos(first), std::sin(first)), corner,
            corner + 200.0 * Vec2(std::cos(second), std::sin(second))};
}

ErrorCode code_of(const std::vector<StrokeEvent>& events, const StrokeOptions& options = {}) {
    return test::error_of([&] { (void)fair_stroke(events, options); }).code();
}

}  // namespace

TEST_CASE("a stroke drawn by hand comes out as fair as it was meant") {
    Hand hand(11);
    double rms = 0.0, turns = 0.0;
    constexpr int kStrokes = 60;
    for (int i = 0; i < kStrokes; ++i) {
        const std::vector<Vec2> meant = bow(hand);
        const auto events = hand.draw(meant, {.jitter = hand.uniform(0.5, 2.0)});
        const Stroke stroke = fair_stroke(events);
        rms += test::distance_to(stroke.points, meant) / kStrokes;
        turns += test::turning(stroke.points) / test::turning(meant) / kStrokes;
        // What jitter makes of an end may look like a small hook.
        CHECK((stroke.points.front() - events.front().pixel).norm() < 8.0);
        CHECK((stroke.points.back() - events.back().pixel).norm() < 8.0);
    }
    CHECK(rms < 1.3);
    CHECK(turns < 1.6);
    CHECK(turns > 0.9);
}

TEST_CASE("corners that were meant stay, at their place, and smooth strokes get none") {
    Hand hand(12);
    int found = 0, wrong = 0, smooth = 0;
    double off = 0.0;
    constexpr int kStrokes = 80;
    for (int i = 0; i < kStrokes; ++i) {
        const std::vector<Vec2> meant = angle(hand, hand.uniform(60.0, 120.0));
        const Stroke stroke = fair_stroke(hand.draw(meant, {.jitter = hand.uniform(0.5, 1.5)}));
        if (stroke.corners.size() == 1) {
            ++found;
            off += (stroke.points[stroke.corners[0]] - meant[1]).norm();
        }
        wrong += stroke.corners.size() > 1;
        smooth += !fair_stroke(hand.draw(bow(hand))).corners.empty();
    }
    CHECK(found >= 0.97 * kStrokes);
    CHECK(off / found < 3.0);
    CHECK(wrong <= 0.03 * kStrokes);
    CHECK(smooth <= 0.05 * kStrokes);
}

TEST_CASE("hooks at the ends are dropped") {
    Hand hand(13);
    double with = 0.0, without = 0.0;
    for (int i = 0; i < 60; ++i) {
        const std::vector<Vec2> meant = bow(hand);
        const auto events = hand.draw(meant, {.jitter = 0.5, .hooks = true});
        with += (events.front().pixel - meant.front()).norm();
        without += (fair_stroke(events).points.front() - meant.front()).norm();
    }
    CHECK(with / 60 > 4.0);
    CHECK(without < 0.6 * with);
}

TEST_CASE("points are evenly spaced and carry times and pressures") {
    Hand hand(14);
    auto events = hand.draw(bow(hand), {.jitter = 0.2, .whole_pixels = false});
    for (std::size_t i = 0; i < events.size(); ++i)
        events[i].pressure = double(i) / (events.size() - 1);
    const Stroke stroke = fair_stroke(events, {.spacing = 6.0});
    REQUIRE(stroke.times.size() == stroke.points.size());
    REQUIRE(stroke.pressures.size() == stroke.points.size());
    for (std::size_t i = 1; i < stroke.points.size(); ++i) {
        CHECK((stroke.points[i] - stroke.points[i - 1]).norm() == Approx(6.0).epsilon(0.1));
        CHECK(stroke.times[i] >= stroke.times[i - 1]);
        CHECK(stroke.pressures[i] >= stroke.pressures[i - 1]);
    }
    CHECK(stroke.points.front() == events.front().pixel);
    CHECK(stroke.points.back() == events.back().pixel);
    CHECK(stroke.pressures.back() == 1.0);
    CHECK(stroke.times.back() == events.back().time);
}

TEST_CASE("a stroke is the same in device pixels and backwards in time") {
    Hand hand(15);
    const auto events = hand.draw(angle(hand, 90.0), {.whole_pixels = false});
    auto doubled = events;
    for (StrokeEvent& event : doubled) event.pixel *= 2.0;
    const Stroke one = fair_stroke(events), two = fair_stroke(doubled, {.scale = 2.0});
    REQUIRE(one.points.size() == two.points.size());
    for (std::size_t i = 0; i < one.points.size(); ++i) {
        CHECK((one.points[i] - two.points[i]).norm() < 1e-9);
    }
    auto still = events;
    for (StrokeEvent& event : still) event.time = -event.time;
    const Stroke frozen = fair_stroke(still);
    CHECK(frozen.points.size() == one.points.size());
    CHECK(frozen.times.front() == frozen.times.back());
}

TEST_CASE("clicks are told from strokes") {
    const std::vector<StrokeEvent> click{{{10, 10}, 0.0}, {{13, 12}, 0.1}};
    CHECK(is_click(click));
    CHECK(fair_stroke(click).points.size() == 1);
    CHECK_FALSE(is_click(std::vector<StrokeEvent>{{{10, 10}, 0.0}, {{13, 12}, 0.5}}));
    CHECK_FALSE(is_click(std::vector<StrokeEvent>{{{10, 10}, 0.0}, {{20, 12}, 0.1}}));
    CHECK(is_click(std::vector<StrokeEvent>{{{10, 10}, 0.0}, {{20, 12}, 0.1}}, 2.0));
}

TEST_CASE("what a hand can do wrong is refused or endured") {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    CHECK(code_of({}) == ErrorCode::invalid_argument);
    CHECK(code_of({{{kNan, 0}, 0}}) == ErrorCode::not_finite);
    CHECK(code_of({{{0, 0}, kNan}}) == ErrorCode::not_finite);
    CHECK(code_of({{{0, 0}, 0}}, {.spacing = 0.0}) == ErrorCode::invalid_argument);
    CHECK(code_of({{{0, 0}, 0}}, {.scale = -1.0}) == ErrorCode::invalid_argument);
    CHECK(code_of({{{0, 0}, 0}}, {.smoothing = -1.0}) == ErrorCode::invalid_argument);
    CHECK(code_of({{{0, 0}, 0}, {{100, 0}, 1}}, {.spacing = 1e-9}) == ErrorCode::invalid_argument);
    CHECK(code_of({{{0, 0}, 0}, {{1e16, 0}, 1}}) == ErrorCode::invalid_argument);
    CHECK(fair_stroke(std::vector<StrokeEvent>{{{3, 4}, 0}}).points.size() == 1);
    // To and fro on one line, and ten thousand points at equal times.
    std::vector<StrokeEvent> line, many;
    for (int i = 0; i < 100; ++i)
        line.push_back({Vec2(i % 20 < 10 ? i % 20 : 20 - i % 20, 0) * 10, i * 0.01});
    Hand hand(16);
    for (int i = 0; i < 10000; ++i)
        many.push_back({{hand.uniform(-5000, 5000), hand.uniform(0, 900)}, 0});
    for (const auto& events : {line, many}) {
        for (const Vec2& p : fair_stroke(events, {.spacing = 50.0}).points) CHECK(p.allFinite());
    }
}

TEST_CASE("without smoothing every event is kept") {
    Hand hand(17);
    const auto events = hand.draw(bow(hand), {.jitter = 2.0});
    const Stroke raw = fair_stroke(events, {.smoothing = 0.0, .spacing = 0.25});
    std::vector<Vec2> drawn;
    for (const StrokeEvent& event : events) drawn.push_back(event.pixel);
    CHECK(test::distance_to(drawn, raw.points) < 0.3);
}
