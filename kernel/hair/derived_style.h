/// DerivedStyle: results of the curves of a hairstyle on its head; private to kernel/hair.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/hair/curve_conflicts.h"
#include "kernel/hair/curve_derivation.h"
#include "kernel/hair/field/distance_grid.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/hair/style_inputs.h"
#include "kernel/solve/grid/grid_constraints.h"

namespace lissom {

/// Owner of the constraints of the scalp step; those of curves are above it.
inline constexpr ConstraintOwner kScalpOwner = 0;

/// Inputs and their results. A value: made whole, and never changed.
struct DerivedStyle {
    StyleInputs inputs;
    /// Ids of the curves, in their order.
    std::vector<CurveId> ids;
    std::vector<std::shared_ptr<const DerivedCurve>> curves;
    /// Constraints of the scalp step and of the curves that are enabled, in their order: conflicts
    /// are settled.
    std::vector<CurveClaim> claims;

    const DerivedCurve& derived(CurveId id) const;
};

/// The head and the grid that curves act on.
struct StyleGround {
    const Scalp& scalp;
    const DistanceGrid& distances;
    /// Whether streams that end close to a tie lead into it.
    bool gathers = false;
    /// Whether errors name the curve, by its number from 1 behind the first `known` ones.
    bool names_curves = false;
    std::size_t known = 0;
};

/// Derives the curves of `inputs`; those whose shape is that of `before` are taken from there.
/// Errors: as derive; cancelled.
DerivedStyle derive_style(StyleInputs inputs, const DerivedStyle& before, const StyleGround& ground,
                          const Context& context = {});

/// Returns the constraints of the field, one a grid point, ascending by point.
std::vector<GridConstraint> decisive_constraints(const DerivedStyle& style,
                                                 std::vector<ConstraintOwner>& owners);

}  // namespace lissom
