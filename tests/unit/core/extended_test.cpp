#include "kernel/core/extended.h"

#include <doctest/doctest.h>

#include <cfloat>

using namespace lissom;

// With 64 bits of mantissa, whatever a `long double` has; a compiler whose `long double` is a
// double has no such numbers.
#if LDBL_MANT_DIG >= 64

namespace {

constexpr double kLast = 0x1p-63;  // of the numbers from 1 to 2

}  // namespace

TEST_CASE("extended: a sum keeps 64 bits, the even one of two that are as near") {
    const Extended one = 1.0, next = one + kLast;
    CHECK(next > one);
    CHECK(static_cast<double>(next - one) == kLast);
    CHECK(one + 0.5 * kLast == one);
    CHECK(one + 0.75 * kLast == next);
    CHECK(next + 0.5 * kLast == one + 2.0 * kLast);
    CHECK(-next - 0.5 * kLast == -one - 2.0 * kLast);
}

TEST_CASE("extended: so do products and quotients") {
    const Extended one = 1.0, next = one + kLast;
    CHECK(next * next == one + 2.0 * kLast);
    CHECK(one / 3.0 * 3.0 == one);
    // What a third has beyond the digits of a double.
    CHECK(static_cast<double>(one / 3.0 - Extended(1.0 / 3.0)) == 0x1.558p-56);
}

TEST_CASE("extended: the carry of what is rounded goes into the exponent") {
    const Extended two = 2.0, below = two - kLast;
    CHECK(below < two);
    CHECK(below + 0.5 * kLast == two);
    CHECK(static_cast<double>(two - below) == kLast);
}

TEST_CASE("extended: becomes the nearest double") {
    const Extended one = 1.0;
    CHECK(static_cast<double>(one + 0x1p-53) == 1.0);
    CHECK(static_cast<double>(one + 0x1p-53 + kLast) == 1.0 + 0x1p-52);
}

#endif
