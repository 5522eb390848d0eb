// Hair over other hair.
#include <cmath>

#include "kernel/core/error.h"
#include "kernel/hair/operators/strand_layer.h"
#include "tests/unit/hair/strands/strand_support.h"

using namespace lissom;
using namespace lissom::test;

namespace {

double from_ball(const Vec3& p) {
    return p.norm() - 0.1;
}

// Strands that run down on a ball of 0.1 metres, `height` above it, from the pole to the equator;
// at the azimuths from `begin` on by `range`.
Strands on_ball(Index count, double height, double begin, double range, double top = 0.1) {
    std::vector<std::vector<Vec3>> lists;
    for (Index s = 0; s < count; ++s) {
        const double turn = begin + range * (s + 0.5) / count;
        std::vector<Vec3> points;
        for (int k = 0; k <= 20; ++k) {
            const double tilt = top + (1.5 - top) * k / 20.0, up = height * std::min(1.0, k / 2.0);
            points.push_back((0.1 + up) * Vec3(std::sin(turn) * std::sin(tilt), std::cos(tilt),
                                               std::cos(turn) * std::sin(tilt)));
        }
        lists.push_back(points);
    }
    return strands_of(lists);
}

double lowest(const Strands& strands, Index first) {
    double low = 1.0;
    for (Index s = 0; s < strands.size(); ++s) {
        for (Index k = first; k < strands.point_count(s); ++k) {
            low = std::min(low, from_ball(point_of(strands.strand(s), k)));
        }
    }
    return low;
}

}  // namespace

TEST_CASE("the thickness of a layer is the height of its hair, and nothing beside it") {
    const LayerThickness layer(on_ball(2000, 0.012, -0.5 * kPi, kPi), from_ball, Vec3::Zero());
    for (const double turn : {-1.0, 0.0, 1.0}) {
        const Vec3 p(0.11 * std::sin(turn), 0.02, 0.11 * std::cos(turn));
        CHECK(layer.at(p) == doctest::Approx(0.012).epsilon(0.1));
    }
    CHECK(layer.at({0.0, 0.02, -0.11}) == 0.0);
    CHECK(layer.at({0.0, -0.1, 0.05}) == 0.0);
    CHECK(LayerThickness(Strands(), from_ball, Vec3::Zero()).at({0, 0.1, 0}) == 0.0);
}

TEST_CASE("strands are lifted over a layer, smoothly, and those beside it stay to the bit") {
    const LayerThickness layer(on_ball(2000, 0.012, -0.5 * kPi, kPi), from_ball, Vec3::Zero());
    LiftOverOptions options;
    options.layer = &layer;
    options.distance = from_ball;
    Strands over = on_ball(200, 0.003, -1.2, 2.4);
    const Strands before = over;
    lift_over(over, options);
    CHECK(lowest(before, 6) < 0.0031);
    CHECK(lowest(over, 6) > 0.0115);
    for (Index s = 0; s < over.size(); ++s) {
        CHECK(over.root(s) == before.root(s));
        CHECK(length(over.strand(s)) == doctest::Approx(length(before.strand(s))).epsilon(0.001));
        for (Index k = 1; k + 1 < over.point_count(s); ++k) {
            const Vec3 a = point_of(over.strand(s), k) - point_of(over.strand(s), k - 1);
            const Vec3 b = point_of(over.strand(s), k + 1) - point_of(over.strand(s), k);
            CHECK(a.normalized().dot(b.normalized()) > std::cos(60.0 * kDegree));
        }
    }
    Strands beside = on_ball(50, 0.003, kPi - 0.8, 1.6, 0.6);
    const std::uint64_t hash_before = hash(beside);
    lift_over(beside, options);
    CHECK(hash(beside) == hash_before);
}

TEST_CASE("lifting refuses what it cannot lift over") {
    Strands strands = on_ball(5, 0.003, 0.0, 1.0);
    const std::uint64_t before = hash(strands);
    LiftOverOptions options;
    CHECK(error_of([&] { lift_over(strands, options); }).code() == ErrorCode::invalid_argument);
    const LayerThickness layer(strands, from_ball, Vec3::Zero());
    options.layer = &layer;
    options.distance = from_ball;
    options.gap = -0.001;
    CHECK(error_of([&] { lift_over(strands, options); }).code() == ErrorCode::invalid_argument);
    CHECK(hash(strands) == before);
}
