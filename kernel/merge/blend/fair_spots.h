/// Fairing of the places near seams at which a side crumpled; private to kernel/merge.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/sew/sew.h"

namespace lissom {

/// Rings around a place that are faired at first, and at most.
inline constexpr Index kMinSpotRings = 2, kMaxSpotRings = 4;

struct SpotFairing {
    /// Place of each vertex of the sewn mesh on the source and on the target at rest, NaN for a
    /// vertex that was not on it.
    std::span<const Vec3> source_rest, target_rest;
    /// Vertices that stay, ascending.
    std::vector<Index> firm = {};
    /// Rings of vertices around a place that are bent anew; at least 1. The surface as many rings
    /// beyond bends with them and keeps its details.
    Index rings = kMinSpotRings;
    /// Vertices farther from the seams than this stay, in their radii.
    double reach = std::numeric_limits<double>::infinity();
};

/// Bends the surface in place around edges of either side that crumpled (crumpled_edges), as
/// fair_seam does around seams: its mean curvature and normals continue those around. Vertices on
/// open boundaries stay. If triangles become thin, edges near the seams are flipped. Morph targets
/// and normals follow. The quality of the seams in the report is measured anew. Returns false, and
/// changes nothing, if no edge crumpled beside a seam of parts that do not fit (Sewn::kept), or if
/// the surface is so folded that it does not say how it bends. Errors: memory_limit; cancelled. The
/// mesh is then unchanged.
bool fair_spots(Sewn& sewn, const SpotFairing& options, const Context& context);

}  // namespace lissom
