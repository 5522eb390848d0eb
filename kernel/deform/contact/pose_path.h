/// The way of handles from one pose to another; private to kernel/deform.
#pragma once

#include <optional>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/deform/holds/constraint_set.h"
#include "kernel/deform/holds/poses.h"
#include "kernel/deform/rest_shape.h"
#include "kernel/deform/rotation/winding.h"

namespace lissom {

/// The way of one handle: it turns and shifts as a screw, and stretches in proportion.
class HandlePath {
  public:
    HandlePath(const RestShape& rest, const Handle& handle, const HandlePose& from,
               const HandlePose& to);

    /// Returns the pose at a `share` of the way: `from` at 0, near `to` at 1.
    HandlePose at(double share) const;
    /// Returns the length of the way of the handle's farthest vertex, at most.
    double length() const;

  private:
    const RestShape& rest_;
    HandlePose from_;
    Vec3 center_;
    double reach_ = 0.0;
    Mat3 rotation_, stretch_from_, stretch_to_;
    Vec3 begin_, way_;
    Screw screw_;
};

/// Replaces poses by those at a `share` of the way to them from others of the same constraint set,
/// without allocations; at 1 they stay to the bit.
void put_between(const RestShape& rest, const ConstraintSet& constraints, const Poses& from,
                 double share, Poses& poses);

/// The way of all handles and targets of a constraint set.
class PosePath {
  public:
    /// Both poses are of `constraints`; the first may lack the handles that were added last, which
    /// begin at rest.
    PosePath(const RestShape& rest, const ConstraintSet& constraints, Poses from, Poses to);

    /// Returns the poses at a `share` of the way, to the bit the last ones at 1.
    Poses at(double share) const;
    /// Returns the greatest length of a way.
    double length() const;

  private:
    Poses from_, to_;
    std::vector<std::optional<HandlePath>> paths_;
};

}  // namespace lissom
