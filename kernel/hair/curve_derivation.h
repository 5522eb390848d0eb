/// Results of a style curve on a head; private to kernel/hair. Metres of the scalp's frame.
#pragma once

#include <optional>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/hair/curve/dividing_curve.h"
#include "kernel/hair/curve/style_curve.h"
#include "kernel/hair/curve/tilt_fit.h"
#include "kernel/hair/field/distance_grid.h"
#include "kernel/hair/growth/growth.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/solve/grid/grid_constraints.h"

namespace lissom {

struct DerivedCurve {
    /// The curve as it acts, in segments of about a step of the grid.
    std::vector<Vec3> course;
    std::vector<GridConstraint> constraints;
    /// Line of a dividing curve: roots nearer to it than half the gap are on bare skin.
    std::optional<DividingLine> line;
    double gap = 0.0;
    /// Tilts of a dividing curve.
    std::optional<TiltFit> tilt;
    /// Tie of a ponytail.
    std::optional<HairTie> tie;
    /// Whether a stream leads into a tie, without its vanishing extension.
    bool gathered = false;
};

/// Errors: as Hairstyle::set.
DerivedCurve derive(const StyleCurve& curve, const Scalp& scalp, const DistanceGrid& distances);

}  // namespace lissom
