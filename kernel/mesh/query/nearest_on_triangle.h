/// Nearest points of single triangles; private to the kernel.
#pragma once

#include <array>

#include "kernel/core/geometry.h"

namespace lissom {

struct PointOfTriangle {
    Vec3 barycentric;
    double squared_distance;
};

/// Returns the foot of the perpendicular from `p` if it lies inside, else the nearest point of an
/// edge; the latter also for triangles with almost no area.
PointOfTriangle nearest_on_triangle(const std::array<Vec3, 3>& corners, const Vec3& p);

}  // namespace lissom
