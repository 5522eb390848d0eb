#include "kernel/hair/curve/tilt_fit.h"

#include <Eigen/Geometry>

#include "tests/unit/hair/curve/curve_scenes.h"

using namespace lissom;
using doctest::Approx;

namespace {

using Polyline = std::vector<Vec3>;

constexpr double kTiltRadius = 0.09;

// Half a great circle's arc over the top of a ball, from front to back; to its right is +x.
DividingLine tilted_parting() {
    Polyline points;
    for (int k = 0; k <= 20; ++k) {
        const double angle = -0.8 + 1.6 * k / 20;
        points.emplace_back(0.0, kTiltRadius * std::cos(angle), -kTiltRadius * std::sin(angle));
    }
    return DividingLine(points, points);
}

// What a hand draws along hair.
struct DrawnHint {
    /// Where it begins: share of the curve, and metres from it, negative on the left.
    double along = 0.5, across = 0.005;
    double length = 0.02;
    /// Standard deviation of the jitter, metres.
    double jitter = 0.0;
};

// On the ball, going as hair does with this tilt from the curve on.
Polyline hint_along(const DividingLine& line, DividingOptions::Tilt tilt, const DrawnHint& drawn,
                    test::RandomPoints& random) {
    const double angle = -0.8 + 1.6 * drawn.along, side = drawn.across < 0.0 ? -1.0 : 1.0;
    Vec3 at(drawn.across, kTiltRadius * std::cos(angle), -kTiltRadius * std::sin(angle));
    Polyline hint;
    const double step = 0.001;
    for (double s = 0.0; s <= drawn.length; s += step) {
        at *= kTiltRadius / at.norm();
        const auto noise = [&] { return random.uniform(-1.7, 1.7) * drawn.jitter; };
        hint.push_back(at + Vec3(noise(), noise(), noise()));
        const DividingPlace place = line.place(at);
        const double a = tilt.start + place.along * (tilt.end - tilt.start);
        at += step * (std::cos(a) * side * place.right + std::sin(a) * place.tangent);
    }
    return hint;
}

Polyline turned_round(Polyline points) {
    std::reverse(points.begin(), points.end());
    return points;
}

double error_in_degrees(const SideTilt& side, DividingOptions::Tilt tilt) {
    return std::max(std::abs(side.tilt.start - tilt.start), std::abs(side.tilt.end - tilt.end)) /
           kDegree;
}

DividingOptions::Tilt random_tilt(test::RandomPoints& random) {
    return {random.uniform(-60, 60) * kDegree, random.uniform(-60, 60) * kDegree};
}

ErrorCode hint_code(const Polyline& hint) {
    return test::error_of([&] { require_hint(tilted_parting(), hint); }).code();
}

std::string hint_refusal(const Polyline& hint) {
    return test::error_of([&] { require_hint(tilted_parting(), hint); }).message();
}

}  // namespace

TEST_CASE("tilt: two hints a side near the ends give back the tilt that they follow") {
    const DividingLine line = tilted_parting();
    test::RandomPoints random(7);
    double worst = 0.0, squares = 0.0;
    constexpr int kTrials = 60;
    for (int trial = 0; trial < kTrials; ++trial) {
        const DividingOptions::Tilt left = random_tilt(random), right = random_tilt(random);
        std::vector<Polyline> hints;
        for (const double along : {0.12, 0.88}) {
            const double jitter = 0.0002;
            hints.push_back(hint_along(line, left, {along, -0.004, 0.02, jitter}, random));
            hints.push_back(hint_along(line, right, {along, 0.004, 0.02, jitter}, random));
        }
        const TiltFit fit = fit_tilt(line, hints);
        for (const double error :
             {error_in_degrees(fit.left, left), error_in_degrees(fit.right, right)}) {
            worst = std::max(worst, error);
            squares += error * error / (2 * kTrials);
        }
        CHECK(fit.left.error < 15.0 * kDegree);
    }
    CHECK(std::sqrt(squares) < 2.5);
    CHECK(worst < 6.0);
}

TEST_CASE("tilt: one hint means an even tilt") {
    const DividingLine line = tilted_parting();
    test::RandomPoints random(11);
    double squares = 0.0;
    constexpr int kTrials = 60;
    for (int trial = 0; trial < kTrials; ++trial) {
        const DividingOptions::Tilt tilt = random_tilt(random);
        const double along = random.uniform(0.2, 0.8);
        const auto hint = hint_along(line, tilt, {along, 0.004, 0.025, 0.0002}, random);
        const SideTilt side = fit_tilt(line, std::vector<Polyline>{hint}).right;
        const double there = tilt.start + along * (tilt.end - tilt.start);
        const double found = side.tilt.start + along * (side.tilt.end - side.tilt.start);
        squares += std::pow((found - there) / kDegree, 2) / kTrials;
        CHECK(std::abs(side.tilt.end - side.tilt.start) <=
              std::abs(tilt.end - tilt.start) + 25.0 * kDegree);
    }
    CHECK(std::sqrt(squares) < 4.0);
    // A tilt that is even is told exactly, wherever the hint is.
    const auto hint = hint_along(line, {0.5, 0.5}, {0.9, 0.004, 0.02}, random);
    CHECK(error_in_degrees(fit_tilt(line, std::vector<Polyline>{hint}).right, {0.5, 0.5}) < 1.0);
}

TEST_CASE("tilt: sides are apart; mirrored hints are alike, and a hint across tells both") {
    const DividingLine line = tilted_parting();
    test::RandomPoints random(3);
    const auto right = hint_along(line, {0.6, 0.6}, {0.4, 0.0005}, random);
    const TiltFit one = fit_tilt(line, std::vector<Polyline>{right});
    CHECK(one.left.pieces == 0);
    CHECK(one.left.tilt == DividingOptions::Tilt{});
    CHECK(one.right.pieces == 6);
    auto left = right;
    for (Vec3& p : left) p.x() = -p.x();
    const TiltFit mirrored = fit_tilt(line, std::vector<Polyline>{left});
    CHECK(mirrored.right.pieces == 0);
    CHECK(mirrored.left.tilt.start == Approx(one.right.tilt.start));
    CHECK(mirrored.left.tilt.end == Approx(one.right.tilt.end));
    auto across = turned_round(left);
    across.insert(across.end(), right.begin(), right.end());
    const TiltFit both = fit_tilt(line, std::vector<Polyline>{across});
    CHECK(both.left.tilt.start == Approx(0.6).epsilon(0.05));
    CHECK(both.right.tilt.start == Approx(0.6).epsilon(0.05));
}

TEST_CASE("tilt: which way a hint was drawn, and how densely, does not matter") {
    const DividingLine line = tilted_parting();
    test::RandomPoints random(5);
    const auto hint = hint_along(line, {-0.4, 0.7}, {0.3, 0.003, 0.024}, random);
    const SideTilt side = fit_tilt(line, std::vector<Polyline>{hint}).right;
    const SideTilt back = fit_tilt(line, std::vector<Polyline>{turned_round(hint)}).right;
    CHECK(back.tilt.start == Approx(side.tilt.start).epsilon(1e-6));
    CHECK(back.tilt.end == Approx(side.tilt.end).epsilon(1e-6));
    Polyline dense;
    for (std::size_t i = 0; i + 1 < hint.size(); ++i) {
        const int count = i < 10 ? 400 : 1;
        for (int k = 0; k < count; ++k) {
            dense.push_back(hint[i] + (hint[i + 1] - hint[i]) * k / count);
        }
    }
    dense.push_back(hint.back());
    const SideTilt same = fit_tilt(line, std::vector<Polyline>{dense}).right;
    CHECK(same.tilt.start == Approx(side.tilt.start).epsilon(1e-6));
    CHECK(same.tilt.end == Approx(side.tilt.end).epsilon(1e-6));
    // Nearly along the curve it is a steep tilt, not one of the other side.
    const auto steep = hint_along(line, {1.5, 1.5}, {0.2, 0.004, 0.024, 0.0001}, random);
    CHECK(fit_tilt(line, std::vector<Polyline>{steep}).right.tilt.start > 1.4);
}

TEST_CASE("tilt: it stays within a right angle") {
    const DividingLine line = tilted_parting();
    // Along the curve and a little towards it.
    const Polyline hint = {line.place(Vec3(0.0, 0.09, 0.0)).normal * 0.09 + Vec3(0.008, 0, 0.02),
                           Vec3(0.0075, 0.09, -0.02)};
    const SideTilt side = fit_tilt(line, std::vector<Polyline>{hint}).right;
    CHECK(side.pieces > 5);
    CHECK(side.tilt.start <= 0.5 * kPi);
    CHECK(side.tilt.start > 1.4);
}

TEST_CASE("tilt: hints that are nowhere beside the curve say why") {
    const Vec3 top(0.0, 0.09, 0.0);
    CHECK(hint_code({Vec3(0.08, 0.04, 0.0), Vec3(0.09, 0.02, 0.0)}) == ErrorCode::out_of_range);
    CHECK(hint_refusal({Vec3(0.08, 0.04, 0.0), Vec3(0.09, 0.02, 0.0)}).find("no nearer than") !=
          std::string::npos);
    CHECK(hint_refusal({top + Vec3(0, -0.001, -0.01), top + Vec3(0, -0.001, 0.01)})
              .find("along it") != std::string::npos);
    CHECK(hint_refusal({Vec3(0.004, 0.058, 0.068), Vec3(0.012, 0.055, 0.07)}).find("ends") !=
          std::string::npos);
    CHECK(hint_code({Vec3(0.0, -0.09, 0.0), Vec3(0.02, -0.09, 0.0)}) == ErrorCode::out_of_range);
    CHECK(hint_code({top}) == ErrorCode::invalid_argument);
    CHECK(hint_code({top, Vec3(0, std::nan(""), 0)}) == ErrorCode::not_finite);
    CHECK(hint_code({top, Vec3(1e9, 0, 0)}) == ErrorCode::out_of_range);
    CHECK_NOTHROW(require_hint(tilted_parting(), {top, top + Vec3(0.02, 0, 0)}));
}

TEST_CASE("tilt: the same far from the origin") {
    const Vec3 off(1e3, -2e3, 5e2);
    const Polyline points = {off, off + Vec3(0, 0, 0.05), off + Vec3(0, 0, 0.1)};
    const DividingLine line(points, std::vector<Vec3>(3, Vec3::UnitY()));
    // Along +z with y up, right is t x n = -x.
    const Polyline hint = {off + Vec3(-0.004, 0, 0.02), off + Vec3(-0.02, 0, 0.036)};
    const SideTilt side = fit_tilt(line, std::vector<Polyline>{hint}).right;
    CHECK(side.tilt.start == Approx(0.25 * kPi).epsilon(1e-6));
    CHECK(side.error < 1e-6);
}
