/// Vertices of a surface that lie inside another part of it; private to kernel/deform.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/self_intersections.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {

/// A vertex inside another part, and the point where it leaves that part on the shortest way that
/// fits all vertices around it.
struct PenetrationPoint {
    Index vertex = kNoIndex;
    Vec3 place = Vec3::Zero();
    /// The triangle that it leaves through, and the barycentric coordinates of the place.
    Triangle exit{kNoIndex, kNoIndex, kNoIndex};
    Vec3 weight = Vec3::Zero();
    /// Unit direction of the way out, for the vertex, against the exit.
    Vec3 way = Vec3::Zero();
    double depth = 0.0;
};

/// Points of two parts, or two sides of a fold, that lie inside one another.
using Penetration = std::vector<PenetrationPoint>;

/// Returns the penetrations that `contacts`, pairs of faces of `shape`, are the rim of. Vertices
/// that lie inside as many parts at rest do not count. Rays along the normals tell the inside: a
/// surface that is open there may have none. Errors: cancelled; memory_limit.
std::vector<Penetration> find_penetrations(const Mesh& shape, const SpatialTree& rest,
                                           std::span<const FacePair> contacts,
                                           const Context& context);

}  // namespace lissom
