/// Geodesic distances by an advancing front.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {

/// Geodesic distance of every vertex to the nearest of `sources`, by a front that advances from
/// triangle to triangle (Melvaer and Reimers, "Geodesic polar coordinates on polygonal meshes",
/// 2012): the source is laid out in the plane of each triangle from the distances of two of its
/// corners. Exact on flat surfaces if straight ways stay on them; elsewhere errors are those of the
/// heat method, about 1 % of the farthest distance. Nothing is prepared, so that one query costs
/// much less than HeatDistances, and many cost more. Infinity in components without a source and
/// beyond `limit`. Polygons are triangulated. Errors: out_of_range; invalid_argument without
/// sources or for a limit that is negative or NaN; cancelled.
std::vector<double> front_distances(const Mesh& mesh, std::span<const Index> sources,
                                    double limit = std::numeric_limits<double>::infinity(),
                                    const Context& context = {});

/// Returns the same from a point of the surface, which need not be a vertex.
std::vector<double> front_distances(const Mesh& mesh, const SurfacePoint& point,
                                    double limit = std::numeric_limits<double>::infinity(),
                                    const Context& context = {});

}  // namespace lissom
