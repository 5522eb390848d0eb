// Angles that are found by comparison, against those of arc tangents.
#include "kernel/merge/loop/face_angles.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace lissom;

namespace {

double smallest_of_three(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::min(
        {angle_between(b - a, c - a), angle_between(c - b, a - b), angle_between(a - c, b - c)});
}

}  // namespace

TEST_CASE("the greatest of angles is that of all, from nearly none to nearly half a turn") {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (const double spread : {1e-9, 1e-5, 1e-2, 1.0, 10.0}) {
        for (int trial = 0; trial < 200; ++trial) {
            GreatestAngle greatest;
            double expected = 0.0;
            for (int k = 0; k < 8; ++k) {
                // Of any length; every other one the wrong way round.
                const Vec3 a = Vec3(0.0, 0.0, 1.0 + 0.5 * unit(random));
                Vec3 b = a + spread * Vec3(unit(random), unit(random), unit(random));
                if (trial % 2 == 1 && k % 2 == 1) b = -1e-3 * b;
                greatest.add(a, b);
                expected = std::max(expected, angle_between(a, b));
            }
            CHECK(std::abs(greatest.value() - expected) <= 1e-15);
        }
    }
    GreatestAngle none;
    CHECK(none.value() == 0.0);
    none.add(0.5);
    none.add(Vec3::UnitX(), Vec3(1.0, 0.1, 0.0));
    CHECK(none.value() == 0.5);
    none.add(Vec3::UnitX(), -Vec3::UnitX());
    CHECK(none.value() == kPi);
}

TEST_CASE("the smallest angle of a triangle is that of its three, for slivers too") {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (const double height : {1.0, 1e-3, 1e-7, 1e-11, 0.0}) {
        for (int trial = 0; trial < 200; ++trial) {
            const Vec3 a(unit(random), height * unit(random), height * unit(random)),
                b(unit(random), height * unit(random), 0.0), c(unit(random), 0.0, 0.0);
            CHECK(smallest_angle(a, b, c) == smallest_of_three(a, b, c));
        }
    }
    const Vec3 p(1.0, 2.0, 3.0);
    CHECK(smallest_angle(p, p, p) == 0.0);
    CHECK(smallest_angle(Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()) ==
          smallest_of_three(Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()));
}
