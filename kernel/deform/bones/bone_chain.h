/// BoneChain: bones one behind the other, turned at their joints, by hand or towards a point.
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"

namespace lissom {

class FramedCurve;

/// Options of inverse kinematics.
struct ReachOptions {
    /// Axis about which a stretched chain bends if the target lies along it; if absent, one square
    /// to it. Of any length but 0.
    Vec3 axis = Vec3::Zero();
    /// Rounds over all joints; 1 to 10,000.
    int rounds = 200;
    /// Distance to the target that is enough, as a part of the chain's length; 0 or more.
    double tolerance = 1e-9;
};

/// Bone i goes from joint i to joint i + 1. Lengths stay; joints turn within limits; the base can
/// be moved. A value.
class BoneChain {
  public:
    /// `joints` in the rest pose, two at least. `limits`: for each bone the greatest angle from its
    /// rest direction as seen from the bone before, or for the first from the world, in radians;
    /// pi for none; an empty list for no limits. Errors: invalid_argument for fewer joints, bones
    /// without length, and limits of another number or out of [0, pi]; not_finite, also for joints
    /// beyond 1e100.
    explicit BoneChain(std::vector<Vec3> joints, std::vector<double> limits = {});

    Index size() const { return count_of(rest_) - 1; }
    /// Returns the joints at rest, and as they are now.
    const std::vector<Vec3>& rest() const { return rest_; }
    std::vector<Vec3> joints() const;
    const std::vector<double>& limits() const { return limits_; }
    double length() const;
    /// Returns the rotation of a bone from rest, in the world.
    Eigen::Quaterniond rotation(Index bone) const;
    /// Returns the maps from the rest pose that carry the bones.
    std::vector<Affine> transforms() const;

    /// Sets the rotations of all bones in the world and the place of the base, without limits.
    /// Errors: invalid_argument for another number of rotations.
    void set(std::span<const Eigen::Quaterniond> rotations, const Vec3& base);
    /// Puts the base at a place; all bones go along. Errors: not_finite, also beyond 1e100.
    void set_base(const Vec3& place);
    /// Turns a bone, and with it those behind, about its joint by an angle in radians, within its
    /// limit. Errors: out_of_range; invalid_argument for an axis without length.
    void turn(Index bone, const Vec3& axis, double angle);
    /// Turns bones so that the tip comes to a target, or as near to it as limits and lengths let
    /// it; the distance to the target never grows. Each round turns joint by joint, by small steps
    /// (cyclic coordinate descent, Wang and Chen 1991), then all joints at once by damped least
    /// squares (Wampler 1986); a chain without limits that is too short, or too long to fold, lies
    /// straight. Linear in the number of bones. Returns the distance that is left. Errors:
    /// not_finite, also for targets beyond 1e100; invalid_argument for options out of range.
    double reach(const Vec3& target, const ReachOptions& options = {});

    /// Lays the chain along a curve: the base at its start, each joint where the curve leaves the
    /// reach of the joint before, bones turned least from one to the next, and by `twist` radians
    /// more from the base to the tip. Lengths and limits stay; behind the end of the curve bones go
    /// on straight. Errors: not_finite.
    void follow(const FramedCurve& curve, double twist = 0.0);

  private:
    /// Returns whether it had to turn the bone back.
    bool limit(Index bone);
    bool is_free() const;
    std::vector<Eigen::Quaterniond> frames() const;
    double distance_to(const Vec3& target) const;
    // Steps of `reach`: bone_reach.cpp.
    bool lie_straight(const Vec3& target);
    void bend_a_little(const Vec3& target, const Vec3& axis);
    void turn_each(const Vec3& target);
    void turn_together(const Vec3& target, double& damping);

    std::vector<Vec3> rest_;
    std::vector<double> limits_;
    // Rotation of each bone as seen from the one before.
    std::vector<Eigen::Quaterniond> turns_;
    Vec3 base_ = Vec3::Zero();
};

}  // namespace lissom
