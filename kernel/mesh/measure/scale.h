/// Lengths whose products a double holds; private to the kernel.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kernel/core/geometry.h"

namespace lissom {

/// Returns whether products of four lengths neither overflow nor lose digits, by the greatest of
/// these lengths squared.
inline bool is_measurable(double longest_squared) {
    return longest_squared > 1e-130 && longest_squared < 1e150;
}

/// Returns a power of two that brings the greatest coordinate of all points near 1, so that
/// products of lengths stay within doubles. `point(k)` is point k of `count`.
template <typename Point>
double scale_to_unit(std::size_t count, const Point& point) {
    double greatest = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
        greatest = std::max(greatest, Vec3(point(k)).cwiseAbs().maxCoeff());
    }
    constexpr int kMostExponent = 1000;
    int exponent = 0;
    std::frexp(greatest, &exponent);
    return std::ldexp(1.0, std::min(-exponent, kMostExponent));
}

}  // namespace lissom
