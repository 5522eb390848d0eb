/// Distances over the surface of a patch; private to kernel/deform.
#pragma once

#include <utility>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/deform/patch/patch.h"

namespace lissom {

/// Geodesic distance of each local vertex of the surface from the nearest of `sources`, which are
/// vertices with a distance to begin with; infinity beyond `limit`. Fronts run over the triangles
/// as in Kimmel and Sethian, "Computing geodesic paths on manifolds" (1998), each taken as the
/// circle around a point or as straight.
std::vector<double> patch_distances(const Patch& patch,
                                    const std::vector<std::pair<Index, double>>& sources,
                                    double limit);

}  // namespace lissom
