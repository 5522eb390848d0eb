/// Resolution of conflicts at grid points that several style curves constrain; private to
/// kernel/hair.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/solve/grid/grid_constraints.h"

namespace lissom {

/// The constraints of one curve.
struct CurveClaim {
    std::vector<GridConstraint> constraints;
    /// A higher rank overrides a lower one.
    int rank = 0;
    ConstraintOwner owner = 0;
    /// PlacedCurve::edit.
    std::int64_t edit = 0;
};

/// Greatest angle between directions that agree, radians.
inline constexpr double kAgreement = kPi / 3.0;

/// Gives all claims to a point the same value and weight, so that each point stands for one vector
/// for any owners and any order of edits. The last claim of the highest rank counts, and with it
/// those that agree with it: their directions differ by at most `kAgreement`, or one of them is
/// zero. The value is their mean by the square of their weights, the weight that of the last.
/// `claims` are in the order of the curves.
void settle_conflicts(std::vector<CurveClaim>& claims);

}  // namespace lissom
