#include "kernel/mesh/measure/angle.h"

#include <doctest/doctest.h>

#include <limits>
#include <random>

using namespace lissom;

TEST_CASE("angles of the upper half plane are those of atan2 to the last bits") {
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> angles(0.0, 3.14159265358979), powers(-300.0, 300.0);
    double worst = 0.0;
    float worst_float = 0.0f;
    for (int i = 0; i < 200000; ++i) {
        const double angle = angles(engine), length = std::exp2(powers(engine));
        const double y = std::abs(length * std::sin(angle)), x = length * std::cos(angle);
        worst = std::max(worst, std::abs(half_plane_angle(y, x) - std::atan2(y, x)));
        const auto a = static_cast<float>(std::sin(angle)), b = static_cast<float>(std::cos(angle));
        worst_float = std::max(worst_float, std::abs(half_plane_angle(a, b) - std::atan2(a, b)));
    }
    CHECK(worst < 9e-16);
    CHECK(worst_float < 5e-7f);
}

TEST_CASE("angles along the axes are exact, and the origin has none") {
    const double pi = 3.14159265358979323846;
    CHECK(half_plane_angle(0.0, 2.0) == 0.0);
    CHECK(half_plane_angle(3.0, 0.0) == pi / 2);
    CHECK(half_plane_angle(0.0, -2.0) == pi);
    CHECK(half_plane_angle(0.0, 0.0) == 0.0);
    CHECK(std::abs(half_plane_angle(1.0, 1.0) - pi / 4) < 2e-16);
    CHECK(std::isnan(half_plane_angle(std::numeric_limits<double>::quiet_NaN(), 1.0)));
}
