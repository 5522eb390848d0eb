#include "kernel/core/roots.h"

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

using namespace lissom;

namespace {

constexpr double kLast = std::numeric_limits<double>::epsilon();

// Numbers of all sizes, the same on every platform.
class Numbers {
  public:
    double next(int max_exponent) {
        const double part = static_cast<double>(random_() >> 11) * 0x1p-53 + 0.5;
        const int span = 2 * max_exponent + 1;
        return std::ldexp(part, static_cast<int>(random_() % span) - max_exponent);
    }

  private:
    std::mt19937_64 random_{7};
};

void add(std::uint64_t& hash, double value) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3u;
}

}  // namespace

TEST_CASE("hypotenuse: that of the C library, to a unit of the last place") {
    Numbers numbers;
    for (int i = 0; i < 20000; ++i) {
        const double a = numbers.next(1000), b = a * numbers.next(60);
        if (!std::isfinite(b) || b < 1e-300) continue;
        const double c = std::hypot(a, b);
        REQUIRE(std::abs(hypotenuse(a, b) / c - 1.0) <= kLast);
        REQUIRE(hypotenuse(-b, a) == hypotenuse(a, b));
    }
}

TEST_CASE("hypotenuse: right triangles of whole numbers are exact, at any size") {
    for (const int exponent : {-1000, -500, 0, 500, 1000}) {
        const double unit = std::ldexp(1.0, exponent);
        CHECK(hypotenuse(3.0 * unit, 4.0 * unit) == 5.0 * unit);
        CHECK(hypotenuse(20.0 * unit, 21.0 * unit) == 29.0 * unit);
        CHECK(hypotenuse(0.0, unit) == unit);
    }
    CHECK(hypotenuse(0.0, 0.0) == 0.0);
    CHECK(std::isinf(hypotenuse(-std::numeric_limits<double>::infinity(), 1.0)));
    CHECK(std::isnan(hypotenuse(std::nan(""), 1.0)));
}

TEST_CASE("cube root: that of the C library's longer numbers, to a unit of the last place") {
    Numbers numbers;
    for (int i = 0; i < 20000; ++i) {
        const double x = numbers.next(1000);
        const auto exact = static_cast<double>(std::cbrt(static_cast<long double>(x)));
        REQUIRE(std::abs(cube_root(x) / exact - 1.0) <= kLast);
        REQUIRE(cube_root(-x) == -cube_root(x));
    }
    for (int i = 0; i < 1000; ++i) REQUIRE(cube_root(1.0 * i * i * i) == i);
    CHECK(std::isinf(cube_root(std::numeric_limits<double>::infinity())));
}

TEST_CASE("roots: the same bits on every platform") {
    Numbers numbers;
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (int i = 0; i < 100000; ++i) {
        const double a = numbers.next(20), b = numbers.next(20);
        add(hash, hypotenuse(a, b));
        add(hash, cube_root(a));
    }
    CHECK(hash == 0x268be7fe1e8beaf4u);
}
