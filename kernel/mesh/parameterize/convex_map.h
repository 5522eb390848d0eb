/// Maps onto a disk; private to kernel/mesh.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/mesh/parameterize/chart.h"
#include "kernel/mesh/parameterize/triangle_shape.h"

namespace lissom {

/// The outer loop around a circle by length, and every other vertex in the weighted mean of its
/// neighbours (Tutte 1963, Floater 1997). Weights are those of harmonic maps, kept between 0.05 and
/// 20: positive ones flip nothing, and unlike ones lose vertices to rounding. Errors: not_a_disk,
/// naming vertices, if a hole is open; not_positive_definite; memory_limit; cancelled.
std::vector<Vec2> convex_map(const Chart& chart, const std::vector<TriangleShape>& shapes,
                             const Context& context);

}  // namespace lissom
