/// Spectral least-squares conformal maps; private to kernel/mesh.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/mesh/parameterize/chart.h"
#include "kernel/mesh/parameterize/triangle_shape.h"

namespace lissom {

/// Returns the map with the least conformal energy (Dirichlet energy less area) beside the spread
/// of its open boundary, whose points count by length (Mullen et al. 2008, section 3, with
/// lengths for their counts of vertices). It is the eigenvector of the least eigenvalue, one
/// complex number a vertex, found by Lanczos iteration with the inverse. Scale and rotation are
/// arbitrary. Errors: not_positive_definite; memory_limit; cancelled.
std::vector<Vec2> conformal_map(const Chart& chart, const std::vector<TriangleShape>& shapes,
                                const Context& context);

}  // namespace lissom
