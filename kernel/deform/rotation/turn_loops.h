/// Turns of many vertices at a time, in vector code chosen at run time; private to kernel/deform.
/// Rotations are unit quaternions (w, x, y, z) of either sign, as nearest_quaternions gives them.
#pragma once

#include <span>

#include "kernel/core/geometry.h"

namespace lissom {

/// First `base`, then the rotation about the vector of the first three numbers of each turn by its
/// length in radians; see rotation_of_turn.
void rotations_of_turns(std::span<const Vec4> turns, const Vec4& base, std::span<Mat3> r);

/// Multiplies each matrix by a further `part` of the rotation that leads from `base` to its own;
/// see turned_further.
void turn_further(std::span<const Vec4> rotation, const Vec4& base, double part, std::span<Mat3> m);

/// The rotations at `share` of the shortest way from one to another; see rotation_between.
void blend_rotations(std::span<const Vec4> from, std::span<const Vec4> to, double share,
                     std::span<Mat3> r);

}  // namespace lissom
