/// The boundary condition of a merge: position of each vertex of the source's boundary, with
/// rotation and scale of the surface there (thesis section 3.3.1); private to kernel/merge.
#pragma once

#include <vector>

#include "kernel/deform/boundary/boundary_deformer.h"
#include "kernel/merge/loop/loop.h"
#include "kernel/merge/loop/loop_pair.h"

namespace lissom {

struct LoopValueOptions {
    /// Smoothing of frames along the loops, in loop lengths; 0 takes raw ones.
    double sigma = 0.015;
    /// Scales from the ratio of tangent lengths at each vertex (the thesis), not one from the
    /// ratio of the loops' sizes. A jagged or noisy loop makes the former too small.
    bool tangent_scales = false;
    /// False leaves directions as they are (thesis section 3.3.2).
    bool turn = true;
};

/// RMS distance of the target's loop to its mean over that of the source's, both by arc length.
double loop_scale(const Loop& source, const Loop& target);

/// One value a vertex of `pair.source`, in its order.
std::vector<BoundaryValue> loop_values(const Loop& source, const Loop& target, const LoopPair& pair,
                                       const LoopValueOptions& options = {});

}  // namespace lissom
