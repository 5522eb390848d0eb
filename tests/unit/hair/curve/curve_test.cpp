#include "kernel/hair/curve/curve.h"

#include <cmath>
#include <limits>

#include "kernel/hair/curve/curve_foot.h"
#include "kernel/mesh/shapes/shapes.h"
#include "tests/unit/hair/hair_support.h"

using namespace lissom;
using doctest::Approx;

namespace {

const std::vector<Vec3> kBent{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {1, 2, 3}};

}  // namespace

TEST_CASE("curve: resampled segments are equally long and keep the ends") {
    for (const double step : {0.01, 0.37, 1.0, 50.0}) {
        const std::vector<Vec3> curve = resampled_curve(kBent, step);
        CHECK(curve.front() == kBent.front());
        CHECK(curve.back() == kBent.back());
        CHECK(curve.size() - 1 == std::max(1.0, std::round(6.0 / step)));
        // At corners the chord is shorter than the way along the curve.
        const double along = 6.0 / static_cast<double>(curve.size() - 1);
        for (std::size_t i = 1; i < curve.size(); ++i) {
            CHECK((curve[i] - curve[i - 1]).norm() < along * (1.0 + 1e-12));
        }
    }
    const std::vector<Vec3> straight{{0, 0, 0}, {0.1, 0, 0}, {0.1, 0, 0}, {5, 0, 0}};
    const std::vector<Vec3> even = resampled_curve(straight, 0.5);
    for (std::size_t i = 0; i < even.size(); ++i) CHECK(even[i].x() == Approx(0.5 * i));
}

TEST_CASE("curve: resampled points lie evenly along a curve, however its points lie") {
    test::RandomPoints random(3);
    for (int round = 0; round < 20; ++round) {
        std::vector<Vec3> curve{Vec3::Zero()};
        for (int k = 0; k < 30; ++k) {
            const double step = std::pow(10.0, random.uniform(-4.0, 0.0));
            const Vec3 way(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), 1.0);
            curve.push_back(curve.back() + step * way.normalized());
        }
        const std::vector<double> lengths = arc_lengths(curve);
        const std::vector<Vec3> even = resampled_curve(curve, 0.03 * lengths.back());
        for (std::size_t i = 0; i < even.size(); ++i) {
            const double at = lengths.back() * static_cast<double>(i) / (even.size() - 1.0);
            CHECK((even[i] - point_at_arc_length(curve, lengths, at)).norm() < 1e-12);
        }
    }
}

TEST_CASE("curve: a smooth one runs through its points, straight where they are") {
    const std::vector<Vec3> smooth = smooth_curve(kBent, 0.1);
    for (const Vec3& p : kBent) CHECK(std::count(smooth.begin(), smooth.end(), p) == 1);
    for (std::size_t i = 1; i < smooth.size(); ++i) {
        CHECK((smooth[i] - smooth[i - 1]).norm() <= 0.1);
    }
    double sharpest = 1.0;
    for (std::size_t i = 2; i < smooth.size(); ++i) {
        const Vec3 a = (smooth[i - 1] - smooth[i - 2]).normalized();
        sharpest = std::min(sharpest, a.dot((smooth[i] - smooth[i - 1]).normalized()));
    }
    CHECK(sharpest > 0.8);
    const std::vector<Vec3> line{{0, 0, 0}, {0.2, 0, 0}, {3, 0, 0}, {3.5, 0, 0}};
    for (const Vec3& p : smooth_curve(line, 0.1)) CHECK(p.tail<2>().norm() < 1e-12);
}

TEST_CASE("curve: moving it moves what is made of it") {
    const Affine map = rotation({1, 2, 3}, 0.7, {4, 5, 6});
    std::vector<Vec3> moved;
    for (const Vec3& p : kBent) moved.push_back(map(p));
    const std::vector<Vec3> a = smooth_curve(kBent, 0.3), b = smooth_curve(moved, 0.3);
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) CHECK((map(a[i]) - b[i]).norm() < 1e-12);
}

TEST_CASE("curve: points inside a head or too near come out to the clearance") {
    const Mesh ball = make_sphere({.radius = 1.0, .segments = 24});
    const DistanceGrid distances(ball, fit_grid({Vec3::Constant(-2), Vec3::Constant(2)}, 60000));
    std::vector<Vec3> points{{0.7, 0.1, 0.2}, {1.05, 0, 0}, {0, 1.8, 0}};
    const Vec3 far = points[2];
    push_out(points, distances, 0.2);
    CHECK(points[0].norm() == Approx(1.2).epsilon(0.01));
    CHECK(points[1].norm() == Approx(1.2).epsilon(0.01));
    CHECK(points[2] == far);
}

TEST_CASE("curve: too few points, and ones that are not finite, are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto code = [](const std::vector<Vec3>& points, double step) {
        return test::error_of([&] { resampled_curve(points, step); }).code();
    };
    CHECK(code({}, 1.0) == ErrorCode::invalid_argument);
    CHECK(code({{1, 2, 3}}, 1.0) == ErrorCode::invalid_argument);
    CHECK(code({{1, 2, 3}, {1, 2, 3}}, 1.0) == ErrorCode::invalid_argument);
    CHECK(code({{1, 2, 3}, {1, nan, 3}}, 1.0) == ErrorCode::not_finite);
    CHECK(code(kBent, 0.0) == ErrorCode::invalid_argument);
    CHECK(code(kBent, nan) == ErrorCode::invalid_argument);
}
