/// Rotation vectors that count full turns: axis times angle in radians, of any length.
#pragma once

#include "kernel/core/geometry.h"

namespace lissom {

/// The rotation about `turn` by its length in radians.
Mat3 rotation_of_turn(const Vec3& turn);

/// The rotation vector of `rotation` nearest to `before`, among those that differ by full turns.
/// Where the rotation is the identity, that is a multiple of a full turn about the axis of
/// `before`.
Vec3 turn_near(const Mat3& rotation, const Vec3& before);

/// The rotation vector after turning on from `before` about and by `further`: what a drag along
/// that path ends with.
Vec3 turned(const Vec3& before, const Vec3& further);

}  // namespace lissom
