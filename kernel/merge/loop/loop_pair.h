/// Correspondence of two boundary loops when a source mesh is merged to a target mesh (thesis
/// section 3.3.1).
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"

namespace lissom {

/// A point of a closed polyline: `t` of the way from point `segment` to the next; 0 <= t < 1.
struct LoopPoint {
    Index segment = 0;
    double t = 0.0;
    bool operator==(const LoopPoint&) const = default;
};

/// The point of the closed polyline through `points`. Errors: out_of_range.
Vec3 point_of(std::span<const Vec3> points, const LoopPoint& place);

/// Two loops that run side by side around one seam. The target's follows its open boundary
/// (surface on the left), the source's runs against its own, so that both run the same way.
struct LoopPair {
    /// Vertices of the loops, in order.
    std::vector<Index> source, target;
    /// For each vertex of `source` its place on the target's loop, and the other way round. Places
    /// follow each other around the loop. Two vertices that meet have t = 0, each at the other.
    std::vector<LoopPoint> on_target, on_source;
};

}  // namespace lissom
