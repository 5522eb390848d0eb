/// Distances that keep hair out of parts of a head that are thinner than the steps of a grid, as
/// ears are; private to kernel/hair.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/hair/field/distance_grid.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Returns the values of `distances`, lowered if the surface of `head`, between grid points, stands
/// out of them: afterwards the interpolated distance is at most kTrustedDistance at every place of
/// the surface. At each place the values at the corners of its cell change by the least sum of
/// squares. A surface that is smooth at the scale of the steps changes nothing. Errors:
/// memory_limit; cancelled.
std::vector<float> collision_distances(const DistanceGrid& distances, const Mesh& head,
                                       const Context& context = {});

/// In steps of the grid: less than the clearance of hair from the head, and more than a grid is
/// wrong on the scalp.
inline constexpr double kTrustedDistance = 0.1;

}  // namespace lissom
