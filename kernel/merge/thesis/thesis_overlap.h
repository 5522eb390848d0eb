/// Targets opened for transition regions that overlap, as in the thesis (section 3.3.3): where a
/// region of the source comes to lie on one of the target, the source's connectivity is kept;
/// private to kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// All targets as one mesh, before they were opened.
struct OverlapTarget {
    Mesh mesh;
    /// By join: the boundary as it was, and the far end of the region beside it, both in the
    /// direction of the surface, and the region's width.
    std::vector<std::vector<Index>> loops, ends;
    double width = 0.0;
    /// For each vertex of the opened target the one it was.
    std::vector<Index> vertex_of;
};

/// What is left of a target without its regions. The far end of each is an open boundary.
struct OpenedForOverlap {
    Mesh mesh;
    MeshMap map;
    /// By join.
    std::vector<std::vector<Index>> loops;
    OverlapTarget whole;
};

/// Takes the regions of all `loops`, each as make_thesis_band, out of a target. What the region
/// encloses, as the tip of a bump, goes with it.
/// Errors: invalid_argument where a region is no band or touches itself or another; cancelled.
OpenedForOverlap open_for_overlap(const Mesh& target, std::span<const std::vector<Index>> loops,
                                  double width, const Context& context);

}  // namespace lissom
