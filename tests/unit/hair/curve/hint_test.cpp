#include "kernel/hair/curve/hint.h"

#include "kernel/hair/curve/curve.h"
#include "kernel/hair/curve/curve_foot.h"
#include "tests/unit/hair/hair_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

// From the origin along x, 0.1 long.
std::vector<Vec3> curve() {
    std::vector<Vec3> points;
    for (int k = 0; k <= 10; ++k) points.emplace_back(0.01 * k, 0.0, 0.0);
    return points;
}

std::vector<Vec3> line(const Vec3& from, const Vec3& to) {
    return resampled_curve(std::vector{from, to}, 0.005);
}

// The sharpest turn between two segments.
double sharpest(const std::vector<Vec3>& points) {
    double worst = 0.0;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const Vec3 a = (points[i] - points[i - 1]).normalized(),
                   b = (points[i + 1] - points[i]).normalized();
        worst = std::max(worst, std::acos(std::clamp(a.dot(b), -1.0, 1.0)));
    }
    return worst;
}

ErrorCode code_of(const auto& operation, const std::vector<Vec3>& hint,
                  const HintOptions& options = {}) {
    return test::error_of([&] { operation(curve(), hint, options); }).code();
}

}  // namespace

TEST_CASE("hint: a foot on a curve, and how far beyond its ends") {
    const std::vector<Vec3> points = curve();
    const CurveFoot foot = foot_on_curve(points, Vec3(0.033, 0.02, 0.0));
    CHECK((foot.point - Vec3(0.033, 0, 0)).norm() < 1e-12);
    CHECK(foot.distance == Approx(0.02));
    CHECK(foot.segment == 3);
    CHECK(foot.t == Approx(0.3));
    CHECK(foot.beyond == 0.0);
    CHECK(foot_on_curve(points, Vec3(-0.02, 0.01, 0.0)).beyond == Approx(-0.02));
    CHECK(foot_on_curve(points, Vec3(0.13, 0.01, 0.0)).beyond == Approx(0.03));
    const std::vector<double> lengths = arc_lengths(points);
    CHECK(arc_length_at(lengths, foot) == Approx(0.033));
    CHECK((point_at_arc_length(points, lengths, 0.033) - foot.point).norm() < 1e-12);
    CHECK(point_at_arc_length(points, lengths, 7.0) == points.back());
    CHECK(point_at_arc_length(points, lengths, -1.0) == points.front());
}

TEST_CASE("hint: cut removes what lies beyond the crossing") {
    // Crosses above the curve, between its points.
    const auto hint = line(Vec3(0.064, -0.05, 0.01), Vec3(0.064, 0.05, 0.01));
    const std::vector<Vec3> result = cut_curve(curve(), hint);
    CHECK(result.size() == 8);
    CHECK((result.back() - Vec3(0.064, 0, 0)).norm() < 1e-12);
    for (std::size_t i = 0; i + 1 < result.size(); ++i) CHECK(result[i] == curve()[i]);
    // Of two crossings the first.
    std::vector<Vec3> twice = hint;
    for (const Vec3& p : line(Vec3(0.03, 0.05, 0.01), Vec3(0.03, -0.05, 0.01))) twice.push_back(p);
    CHECK(cut_curve(curve(), twice).back().x() == Approx(0.03));
    // Parallel to the curve: some point of it, and no more.
    CHECK(cut_curve(curve(), line(Vec3(0.05, 0.01, 0), Vec3(0.08, 0.01, 0))).back().x() <= 0.0801);
}

TEST_CASE("hint: concatenate replaces what is beyond its start and goes on smoothly") {
    const auto hint = line(Vec3(0.062, 0.005, 0), Vec3(0.12, 0.08, 0.03));
    const std::vector<Vec3> result = concatenated_curve(curve(), hint);
    CHECK(result.front() == curve().front());
    CHECK(result.back() == hint.back());
    CHECK(sharpest(result) < 0.3);
    // The curve up to the join is as it was.
    for (int k = 0; k <= 4; ++k) CHECK(result[k] == curve()[k]);
    for (const Vec3& p : result) CHECK(p.x() < 0.1201);
    CHECK(curve_length(result) == Approx(0.062 + curve_length(hint)).epsilon(0.03));
    for (std::size_t i = 1; i < result.size(); ++i) CHECK(result[i] != result[i - 1]);
}

TEST_CASE("hint: concatenate at the ends of the curve") {
    const auto on = line(Vec3(0.11, 0.0, 0), Vec3(0.2, 0.0, 0));
    const std::vector<Vec3> longer = concatenated_curve(curve(), on);
    CHECK(curve_length(longer) == Approx(0.2));
    CHECK(sharpest(longer) < 1e-6);
    // All but the root is replaced; the hint is shorter than the join.
    const auto anew = line(Vec3(0.0, 0.001, 0), Vec3(0.0, 0.009, 0));
    const std::vector<Vec3> replaced = concatenated_curve(curve(), anew);
    CHECK(replaced.front() == curve().front());
    CHECK((replaced.back() - anew.back()).norm() < 1e-12);
}

TEST_CASE("hint: insert takes the place of the part between, whichever way it runs") {
    std::vector<Vec3> hint{{0.03, 0.002, 0}, {0.04, 0.02, 0}, {0.06, 0.02, 0}, {0.07, 0.002, 0}};
    hint = smooth_curve(hint, 0.002);
    HintOptions options;
    options.join = 0.005;
    const std::vector<Vec3> result = inserted_curve(curve(), hint, options);
    CHECK(result.front() == curve().front());
    CHECK(result.back() == curve().back());
    CHECK(sharpest(result) < 0.5);
    double highest = 0.0;
    for (std::size_t i = 0; i < result.size(); ++i) {
        highest = std::max(highest, result[i].y());
        if (i > 0) CHECK(result[i] != result[i - 1]);
        if (result[i].x() < 0.024 || result[i].x() > 0.076) CHECK(result[i].y() == Approx(0.0));
    }
    CHECK(highest > 0.019);
    std::reverse(hint.begin(), hint.end());
    const std::vector<Vec3> again = inserted_curve(curve(), hint, options);
    REQUIRE(again.size() == result.size());
    for (std::size_t i = 0; i < result.size(); ++i) CHECK((again[i] - result[i]).norm() < 1e-9);
}

TEST_CASE("hint: which operation a stroke means") {
    const auto kind = [](const Vec3& from, const Vec3& to) {
        return hint_operation(curve(), line(from, to));
    };
    // Across, from far and from near.
    CHECK(kind({0.05, 0.1, 0}, {0.05, -0.1, 0}) == HintOperation::cut);
    CHECK(kind({0.05, 0.004, 0}, {0.052, -0.02, 0}) == HintOperation::cut);
    // Away from the curve, and from its tip.
    CHECK(kind({0.05, -0.003, 0}, {0.08, -0.06, 0}) == HintOperation::concatenate);
    CHECK(kind({0.098, 0.002, 0}, {0.11, -0.06, 0}) == HintOperation::concatenate);
    CHECK(kind({0.05, 0.004, 0}, {0.08, -0.004, 0}) == HintOperation::insert);
    CHECK(kind({0.08, 0.004, 0}, {0.05, -0.004, 0}) == HintOperation::insert);
}

TEST_CASE("hint: its general direction tells a cut from a concatenation that begins across") {
    // Both begin 3 mm beside the curve and cross it at once.
    const auto kind = [](double degrees, double length) {
        const Vec3 from(0.05, 0.003, 0);
        const double a = degrees * kPi / 180.0;
        return hint_operation(curve(),
                              line(from, from + length * Vec3(std::cos(a), -std::sin(a), 0)));
    };
    CHECK(kind(95, 0.025) == HintOperation::cut);
    CHECK(kind(120, 0.025) == HintOperation::cut);
    CHECK(kind(30, 0.06) == HintOperation::concatenate);
    CHECK(kind(50, 0.06) == HintOperation::concatenate);
    // As far above the curve as it may be, the reading is the same.
    CHECK(hint_operation(curve(), line(Vec3(0.05, 0.003, 0.004), Vec3(0.05, -0.022, 0.004))) ==
          HintOperation::cut);
}

TEST_CASE("hint: drawn strokes are read as they were meant, and doubtful ones say so") {
    // Cuts at 60 to 120 degrees, concatenations within 75 degrees of the way to the tip, insertions
    // either way, with ends that miss the curve.
    test::RandomPoints random(7);
    const std::vector<Vec3> path = smooth_curve(
        std::vector<Vec3>{{0, 0, 0}, {0.06, 0.02, 0}, {0.12, 0.01, 0}, {0.2, 0.05, 0}}, 0.004);
    const std::vector<double> lengths = arc_lengths(path);
    const std::vector<Vec3> tangents = curve_tangents(path);
    const auto turned = [](const Vec3& v, double degrees) {
        return Vec3(Eigen::AngleAxisd(degrees * kPi / 180.0, Vec3::UnitZ()) * v);
    };
    const auto at = [&](double share) {
        return point_at_arc_length(path, lengths, share * lengths.back());
    };
    const auto along = [&](double share) {
        return point_at_arc_length(tangents, lengths, share * lengths.back()).normalized();
    };
    constexpr double kPixel = 0.007 / 20.0;
    int right = 0, sure = 0, sure_right = 0;
    const int count = 300;
    for (int i = 0; i < count; ++i) {
        const double side = i % 2 == 0 ? 1.0 : -1.0, share = random.uniform(0.2, 0.9);
        const Vec3 place = at(share), tangent = along(share);
        std::vector<Vec3> hint;
        HintOperation meant = HintOperation::cut;
        if (i % 3 == 0) {
            const Vec3 way = turned(tangent, side * random.uniform(60, 120));
            const double length = random.uniform(20, 200) * kPixel,
                         before = random.uniform(0.3, 0.7);
            hint = {place - before * length * way, place + (1.0 - before) * length * way};
        } else if (i % 3 == 1) {
            meant = HintOperation::concatenate;
            const Vec3 from = place + random.uniform(-12, 12) * kPixel * turned(tangent, 90);
            const Vec3 way = turned(tangent, side * random.uniform(10, 75));
            hint = {from, from + random.uniform(100, 400) * kPixel * way};
        } else {
            meant = HintOperation::insert;
            const double other = share > 0.5 ? share - 0.3 : share + 0.3;
            const double height = random.uniform(12, 60) * kPixel;
            hint = {place + random.uniform(-10, 10) * kPixel * turned(tangent, 90),
                    at(0.5 * (share + other)) + side * height * turned(along(0.5), 90),
                    at(other) + random.uniform(-10, 10) * kPixel * turned(along(other), 90)};
        }
        const HintReading reading = hint_reading(path, smooth_curve(hint, kPixel));
        const bool good = reading.operation == meant;
        right += good;
        sure += reading.sure;
        sure_right += reading.sure && good;
    }
    CHECK(right > 0.95 * count);
    CHECK(sure > 0.8 * count);
    CHECK(sure_right > 0.98 * sure);
}

TEST_CASE("hint: strokes that are nowhere near are refused, and say how far they are") {
    const auto away = line(Vec3(0, 0.1, 0), Vec3(0.1, 0.1, 0));
    CHECK(code_of(cut_curve, away) == ErrorCode::out_of_range);
    CHECK(code_of(concatenated_curve, away) == ErrorCode::out_of_range);
    CHECK(code_of(inserted_curve, away) == ErrorCode::out_of_range);
    CHECK(test::error_of([&] { hint_operation(curve(), away); }).code() == ErrorCode::out_of_range);
    const Error error = test::error_of([&] { cut_curve(curve(), away); });
    CHECK(error.message().find("0.1 m away") != std::string::npos);
    // Starts near, ends far.
    CHECK(code_of(inserted_curve, line(Vec3(0.05, 0, 0), Vec3(0.05, 0.1, 0))) ==
          ErrorCode::out_of_range);
}

TEST_CASE("hint: bad strokes and options are refused") {
    const auto across = line(Vec3(0.05, -0.02, 0), Vec3(0.05, 0.02, 0));
    auto bad = across;
    bad[1].x() = test::kNaN;
    CHECK(code_of(cut_curve, bad) == ErrorCode::not_finite);
    CHECK(code_of(inserted_curve, {across[0]}) == ErrorCode::invalid_argument);
    // Both ends at one place of the curve.
    CHECK(code_of(inserted_curve, across) == ErrorCode::invalid_argument);
    CHECK(code_of(cut_curve, line(Vec3(0, -0.02, 0), Vec3(0, 0.02, 0))) ==
          ErrorCode::invalid_argument);
    CHECK(code_of(cut_curve, across, {.reach = -1.0}) == ErrorCode::invalid_argument);
    for (const double near : {0.0, -1.0, test::kNaN}) {
        const Error error = test::error_of([&] { hint_reading(curve(), across, near); });
        CHECK(error.code() == ErrorCode::invalid_argument);
        CHECK(error.message().find("`near`") != std::string::npos);
    }
    CHECK(code_of(concatenated_curve, across, {.join = test::kNaN}) == ErrorCode::invalid_argument);
    CHECK(test::error_of([&] { cut_curve(std::vector<Vec3>{}, across); }).code() ==
          ErrorCode::invalid_argument);
}
