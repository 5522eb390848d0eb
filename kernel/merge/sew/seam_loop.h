/// The vertices of a seam: those of two loops that run side by side, in one order; private to
/// kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/loop/loop_pair.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// A vertex of the target's loop, of the source's, or of both if two of them meet. Its place on a
/// loop that it is a vertex of has t = 0.
struct SeamVertex {
    LoopPoint on_target, on_source;
    bool of_target = false, of_source = false;
};

/// Checks that each join is one of two whole open boundaries that run side by side.
/// Errors: out_of_range, invalid_argument (counts that differ), not_a_boundary; boundary_conflict
/// if the places do not follow each other around the loop or two joins use one boundary.
void require_joins(const Topology& target, const Topology& source, std::span<const LoopPair> joins);

/// The seam's vertices in the order of the target's loop, from its first vertex on. `join` must be
/// sound.
std::vector<SeamVertex> seam_loop(const LoopPair& join);

/// Returns the position of a vertex of the seam: on the target's loop through `points`.
Vec3 seam_point(std::span<const Vec3> points, const SeamVertex& vertex);

/// Makes one vertex of neighbours from different loops that are closer than `limit` mean seam
/// edges, the nearest first. The vertex of the target stays, so that the target keeps its shape.
/// Returns how many there were.
Index snap(std::vector<SeamVertex>& seam, std::span<const Vec3> target_points, double limit);

}  // namespace lissom
