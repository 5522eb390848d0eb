/// Whether two triangles meet elsewhere than at their common vertices; private to the kernel.
#pragma once

#include <array>

#include "kernel/core/geometry.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {

/// Returns true if the triangles `a` and `b` with the given corners have a point in common that is
/// not on a vertex or edge both have; equal numbers mean one vertex. Points closer than `tolerance`
/// (a length) touch.
bool triangles_intersect(const Triangle& a, const std::array<Vec3, 3>& a_corners, const Triangle& b,
                         const std::array<Vec3, 3>& b_corners, double tolerance);

/// Returns the same for triangles whose corners are one vertex if they lie at one place.
bool triangles_meet(const std::array<Vec3, 3>& a_corners, const std::array<Vec3, 3>& b_corners,
                    double tolerance);

}  // namespace lissom
