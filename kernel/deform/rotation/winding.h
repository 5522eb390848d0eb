/// Rotation vectors that count full turns: axis times angle in radians, of any length.
#pragma once

#include "kernel/core/geometry.h"

namespace lissom {

/// From this angle on a rotation is turned further by less and less; see turned_further.
inline constexpr double kSureTurn = 150.0 * kPi / 180.0;

/// The rotation about `turn` by its length in radians.
Mat3 rotation_of_turn(const Vec3& turn);

/// Returns the rotation vector of `rotation` nearest to `before`, among those that differ by
/// full turns. For the identity, that is a multiple of a full turn about the axis of
/// `before`.
Vec3 turn_near(const Mat3& rotation, const Vec3& before);

/// The rotation at `fraction` of the shortest way from one to another.
Mat3 rotation_between(const Mat3& from, const Mat3& to, double fraction);

/// Returns a `part` of the least rotation vector of a rotation, as a further rotation. Near half a
/// turn, as that vector may point either way, it fades to nothing.
Mat3 turned_further(const Mat3& rotation, double part);

/// A rigid motion as a screw and a shift: while everything turns evenly about and by `turn`, a
/// centre moves along `velocity`, which turns with it; the `remainder` is the centre's distance
/// from its goal then.
struct Screw {
    Vec3 turn = Vec3::Zero(), velocity = Vec3::Zero(), remainder = Vec3::Zero();

    /// Returns the move of the centre when `part` of the screw is done.
    Vec3 shift(double part) const;
};

/// The screw of a motion that turns by `turn` and moves its centre by `shift`. The smaller the
/// turn, or the nearer to a full one, whose axis would lie at infinity, the more of the shift is
/// left as remainder.
Screw screw_of(const Vec3& turn, const Vec3& shift);

/// 0 up to t = 0, 1 from t = 1 on, smooth between.
double smooth_step(double t);

/// Returns the rotation vector after turning on from `before` about and by `further`: the end of a
/// drag along that path.
Vec3 turned(const Vec3& before, const Vec3& further);

}  // namespace lissom
