/// The scalp step: constraints that keep hair from growing into the head (thesis, section 4.6).
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/hair/field/hair_field.h"
#include "kernel/solve/grid/grid_constraints.h"

namespace lissom {

/// Lengths are those of the field's grid.
struct ScalpStepOptions {
    /// Grid points nearer to the surface of the head than this, on either side, are near the scalp.
    /// Above 0; one step of the grid by default, so that the corners of the cells that the surface
    /// runs through are among them, but for a few.
    std::optional<double> band = std::nullopt;
    /// Length of the vectors: small, so that they change the field little elsewhere; above 0.
    double magnitude = 0.3;
    /// omega of equation (4.2).
    double weight = 100.0;
    /// Restricts the step to grid points for which it returns true; it gets their coordinates.
    /// Empty for all that are near the surface.
    std::function<bool(const Vec3&)> where = {};
    /// Whether hair grows at a place: there all grid points are constrained, elsewhere (face, neck,
    /// shoulders) those whose direction points inward, so that hair that flows there stays outside
    /// and the rest of the field keeps its freedom. Empty: all, everywhere.
    std::function<bool(const Vec3&)> scalp = {};
};

/// Returns constraints for all grid points near the scalp, ascending by point: the direction of the
/// field of the last solve; if it points inward, its projection on the tangent plane of the nearest
/// point of the head, with the gradient of the distance as normal. Points that are constrained
/// already are left to their owners, and so are points without a direction to keep: to repeat the
/// step, take away the constraints of the last one and solve first. Give the result to an owner of
/// its own, and solve. Errors: invalid_argument for options out of range.
std::vector<GridConstraint> scalp_step(const HairField& field,
                                       const ScalpStepOptions& options = {});

}  // namespace lissom
