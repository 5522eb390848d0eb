/// Rotations between directions.
#pragma once

#include <Eigen/Geometry>

#include "kernel/core/geometry.h"

namespace lissom {

/// Returns the rotation by the least angle that takes the direction of `from` to that of `to`;
/// between opposite directions, half a turn about some axis square to them. Neither has length
/// zero.
Eigen::Quaterniond min_rotation(const Vec3& from, const Vec3& to);

}  // namespace lissom
