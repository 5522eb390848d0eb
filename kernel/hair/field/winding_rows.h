/// Winding numbers of a closed surface at all points of a grid, row by row.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/hair/field/closed_surface.h"
#include "kernel/hair/field/grid_layout.h"

namespace lissom {

/// Returns one flag a grid point: 1 if the surface winds around it in the direction of its volume's
/// sign, so that it lies inside. Each row of points along x sums the signs of the triangles that it
/// runs through; how a row meets an edge is decided once for all triangles at the edge, so that
/// nothing is counted twice or lost, and the sum over a whole row is exactly 0. Overlapping parts
/// count as one; a part inside another that faces the other way is a hollow. Errors: memory_limit;
/// cancelled.
std::vector<std::uint8_t> inside_flags(const ClosedSurface& surface, const GridLayout& grid,
                                       const Context& context = {});

}  // namespace lissom
