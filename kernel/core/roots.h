/// Roots with the same last bits for every C library and processor; C libraries fuse different
/// multiplications and additions.
#pragma once

#include <cmath>
#include <utility>

namespace lissom {
namespace detail {

// The root h of the rounded squares, less (h^2 - a^2 - b^2) / (2 h), for a >= b > 0; nearly equal
// terms are subtracted first.
inline double corrected_hypotenuse(double a, double b) {
    const double h = std::sqrt(a * a + b * b);
    if (h <= 2.0 * b) {
        const double d = h - b;
        return h - (a * (2.0 * d - a) + (d - 2.0 * (a - b)) * d) / (2.0 * h);
    }
    const double d = h - a;
    return h - (2.0 * d * (a - 2.0 * b) + ((4.0 * d - b) * b + d * d)) / (2.0 * h);
}

}  // namespace detail

/// sqrt(a^2 + b^2), to less than a unit of the last place; it neither overflows nor loses digits on
/// the way. Returns a value that is not finite if a or b is not. After C. F. Borges, An Improved
/// Algorithm for hypot(a, b), 2019.
inline double hypotenuse(double a, double b) {
    constexpr double kLarge = 0x1p500, kSmall = 0x1p-450, kScale = 0x1p600, kNothing = 0x1p-54;
    a = std::abs(a);
    b = std::abs(b);
    if (a < b) std::swap(a, b);
    if (!(b > kNothing * a)) return a + b;
    if (a > kLarge) return detail::corrected_hypotenuse(a / kScale, b / kScale) * kScale;
    if (b < kSmall) return detail::corrected_hypotenuse(a * kScale, b * kScale) / kScale;
    return detail::corrected_hypotenuse(a, b);
}

/// Returns the real cube root of `x`; exact if it is a double with few digits.
inline double cube_root(double x) {
    if (x == 0.0 || !std::isfinite(x)) return x;
    // A step of Newton's method: the power of a rounded third is off by some last places. The loss
    // of the square is added to the residual, as `x` and the third power are nearly equal.
    int exponent = 0;
    const double part = std::frexp(std::abs(x), &exponent);
    const int third = exponent / 3;
    const double rest = std::ldexp(part, exponent - 3 * third);
    const double root = std::pow(rest, 1.0 / 3.0);
    const double square = root * root, lost = std::fma(root, root, -square);
    const double corrected = root - (std::fma(square, root, -rest) + lost * root) / (3.0 * square);
    return std::copysign(std::ldexp(corrected, third), x);
}

}  // namespace lissom
