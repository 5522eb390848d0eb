/// Vertices of a source that come to stand out beside a seam; private to kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// The vertices of a mesh that are looked at, and their places now and at rest: NaN for a vertex
/// without one.
struct PinchPlaces {
    const Mesh& mesh;
    std::span<const Vec3> rest;
    /// Distance of every vertex from the seam along edges, and the greatest of those looked at.
    std::span<const double> distance;
    double reach = 0.0;
};

/// A vertex that became a thorn or a pit, and the mean distance of its neighbours from its axis.
struct Pinch {
    Index vertex = kNoIndex;
    double width = 0.0;
};

/// Returns the vertices whose neighbours slope away from them by 30 degrees more than at rest, to
/// either side, ascending. The slope of a vertex is the angle whose tangent is its height over the
/// mean of its neighbours, along the normal of the faces around it, over their mean distance from
/// that normal: a bump that becomes a dent changes by the sum of both, and one that becomes flatter
/// does not count. Slopes of less than 10 degrees do not show. Vertices that have neighbours
/// without a place at rest are left out, and those on open boundaries. The same under similarities
/// of either place.
std::vector<Pinch> pinches(const PinchPlaces& places);

}  // namespace lissom
