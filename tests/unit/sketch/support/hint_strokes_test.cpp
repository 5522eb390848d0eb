// Hints as a hand draws them: noisy strokes on pictures of several scales.
#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "kernel/hair/curve/curve.h"
#include "kernel/hair/curve/curve_foot.h"
#include "kernel/hair/curve/hint.h"
#include "kernel/sketch/stroke.h"
#include "tests/unit/sketch/hand.h"

using namespace lissom;

namespace {

// A curve on the picture with what hints are drawn from.
struct SeenCurve {
    std::vector<Vec3> points, tangents;
    std::vector<double> lengths;

    explicit SeenCurve(const std::vector<Vec3>& metres, double zoom) {
        std::vector<Vec3> pixels;
        for (const Vec3& p : metres)
            pixels.emplace_back(400.0 + zoom * p.x(), 60.0 + zoom * p.y(), 0.0);
        points = smooth_curve(pixels, 5.0);
        tangents = curve_tangents(points);
        lengths = arc_lengths(points);
    }
    double length() const { return lengths.back(); }
    Vec2 at(double place) const { return point_at_arc_length(points, lengths, place).head<2>(); }
    Vec2 tangent(double place) const {
        return point_at_arc_length(tangents, lengths, place).head<2>().normalized();
    }
    Vec2 aside(double place, double way) const {
        const Vec2 t = tangent(place);
        return at(place) + way * Vec2(-t.y(), t.x());
    }
};

Vec2 turned(const Vec2& v, double degrees) {
    return Eigen::Rotation2Dd(degrees * kDegree) * v;
}

struct DrawnHint {
    HintOperation meant = HintOperation::cut;
    std::vector<Vec2> points;
};

DrawnHint cut_across(const SeenCurve& curve, test::Hand& hand, bool hard) {
    const double place = hand.uniform(0.25, 0.9) * curve.length();
    const double side = hand.uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
    const double least = hard ? 45.0 : 60.0;
    const Vec2 way = turned(curve.tangent(place), side * hand.uniform(least, 180.0 - least));
    const double length =
        hand.uniform(-1.0, 2.0) < 0.0 ? hand.uniform(20.0, 44.0) : hand.uniform(44.0, 160.0);
    const double before = hand.uniform(0.35, 0.65);
    return {
        HintOperation::cut,
        {curve.at(place) - before * length * way, curve.at(place) + (1.0 - before) * length * way}};
}

DrawnHint going_on(const SeenCurve& curve, test::Hand& hand, bool hard) {
    const bool middle = hand.uniform(0.0, 1.0) < 0.4;
    const double place = (middle ? hand.uniform(0.3, 0.9) : 1.0) * curve.length();
    const Vec2 from = curve.aside(place, hand.uniform(-14.0, 14.0));
    const double side = hand.uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
    const Vec2 way = turned(curve.tangent(place), side * hand.uniform(middle ? 15.0 : 0.0, 75.0));
    const double length = hand.uniform(hard ? 60.0 : 100.0, 400.0);
    const Vec2 end = from + length * way;
    const Vec2 bow = 0.1 * length * side * Vec2(-way.y(), way.x());
    return {HintOperation::concatenate, {from, 0.5 * (from + end) + bow, end}};
}

DrawnHint between(const SeenCurve& curve, test::Hand& hand, bool) {
    const double way = std::max(60.0, hand.uniform(0.2, 0.5) * curve.length());
    const double place = hand.uniform(0.05, 0.9) * std::max(curve.length() - way, 1.0);
    const bool flat = hand.uniform(0.0, 1.0) < 0.2;
    const double height = (hand.uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0) *
                          (flat ? hand.uniform(12.0, 22.0) : hand.uniform(22.0, 80.0));
    DrawnHint hint{HintOperation::insert, {}};
    for (int i = 0; i <= 12; ++i) {
        const double t = i / 12.0, rise = height * std::sin(kPi * t);
        const double ends = (i == 0 || i == 12) ? hand.uniform(-10.0, 10.0) : 0.0;
        hint.points.push_back(curve.aside(place + t * way, rise + ends));
    }
    if (hand.uniform(0.0, 1.0) < 0.5) std::reverse(hint.points.begin(), hint.points.end());
    return hint;
}

struct Score {
    int count = 0, right = 0, sure = 0, sure_right = 0, offered = 0;
    std::array<int, 4> by_zoom{}, of_zoom{};
};

Score read_many(std::uint32_t seed, int count, bool hard) {
    const std::vector<std::vector<Vec3>> shapes{
        {{0, 0, 0}, {0.06, 0.05, 0}, {0.1, 0.13, 0}, {0.12, 0.22, 0}},
        {{0.1, 0, 0}, {0.04, 0.08, 0}, {0.09, 0.16, 0}, {0.05, 0.24, 0}},
        {{0, 0, 0}, {0.002, 0.1, 0}, {0, 0.2, 0}},
        {{0, 0.05, 0}, {0.08, 0, 0}, {0.16, 0.03, 0}, {0.2, 0.12, 0}},
        {{0, 0, 0}, {0.1, 0.1, 0}, {0.22, 0.13, 0}}};
    constexpr std::array<double, 4> kZooms{1000.0, 2000.0, 4000.0, 8000.0};
    test::Hand hand(seed);
    Score score;
    for (int i = 0; i < count; ++i) {
        const std::size_t zoom = static_cast<std::size_t>(i) % 4;
        const SeenCurve curve(shapes[static_cast<std::size_t>(i / 4) % 5], kZooms[zoom]);
        const auto make = i % 3 == 0 ? cut_across : i % 3 == 1 ? going_on : between;
        const DrawnHint hint = make(curve, hand, hard);
        test::HandOptions options;
        options.jitter = hard ? hand.uniform(1.0, 3.0) : hand.uniform(0.5, 2.0);
        options.speed = hand.uniform(300.0, 1200.0);
        const Stroke stroke = fair_stroke(hand.draw(hint.points, options));
        std::vector<Vec3> seen;
        for (const Vec2& p : stroke.points) seen.emplace_back(p.x(), p.y(), 0.0);
        const HintReading reading = hint_reading(curve.points, seen, 20.0);
        const bool right = reading.operation == hint.meant;
        const auto& others = reading.others;
        ++score.count, ++score.of_zoom[zoom];
        score.right += right, score.by_zoom[zoom] += right;
        score.sure += reading.sure, score.sure_right += reading.sure && right;
        score.offered +=
            right || std::find(others.begin(), others.end(), hint.meant) != others.end();
    }
    return score;
}

}  // namespace

TEST_CASE("hint strokes: 98 % are read as they were meant, at any zoom; the rest is offered") {
    for (const std::uint32_t seed : {2024u, 50417u, 900133u}) {
        CAPTURE(seed);
        const Score score = read_many(seed, 1200, false);
        MESSAGE(score.right << " of " << score.count << ", sure " << score.sure_right << " of "
                            << score.sure << ", by zoom " << score.by_zoom[0] << " "
                            << score.by_zoom[1] << " " << score.by_zoom[2] << " "
                            << score.by_zoom[3]);
        CHECK(score.right >= 0.98 * score.count);
        for (std::size_t zoom = 0; zoom < 4; ++zoom) {
            CHECK(score.by_zoom[zoom] >= 0.95 * score.of_zoom[zoom]);
        }
        CHECK(score.sure >= 0.85 * score.count);
        CHECK(score.sure_right >= 0.99 * score.sure);
        CHECK(score.offered >= 0.999 * score.count);
    }
}

TEST_CASE("hint strokes: of harder ones, steeper, shorter and shakier, 95 %") {
    for (const std::uint32_t seed : {77u, 31013u, 700001u}) {
        CAPTURE(seed);
        const Score score = read_many(seed, 600, true);
        MESSAGE(score.right << " of " << score.count);
        CHECK(score.right >= 0.95 * score.count);
    }
}
