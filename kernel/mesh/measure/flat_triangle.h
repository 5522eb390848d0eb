/// Areas of triangles seen along a normal, and the limit below which they count as flat; private to
/// the kernel.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "kernel/core/geometry.h"

namespace lissom {

/// A triangle is flat if its area is below this fraction of its longest side squared.
inline constexpr double kFlatTriangle = 1e-9;

inline double longest_side_squared(const Vec3& a, const Vec3& b, const Vec3& c) {
    return std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
}

/// Returns twice the area of a triangle seen along the unit normal.
inline double signed_area(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
    return (b - a).cross(c - a).dot(normal);
}

}  // namespace lissom
