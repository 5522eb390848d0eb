/// Smoothing of a seam; private to kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Smoothing of a seam: steps at most, and whether each is guarded.
struct SeamSmoothing {
    Index times = 0;
    bool guarded = true;
};

/// Moves the vertices of `seams` and, half as far, those next to them by the umbrella operator
/// (Kobbelt et al. 1998): half of the way to the mean of their neighbours, up to `times` times.
/// With `guarded` each step is guarded (SeamGuard), and the first that would do harm is the last;
/// otherwise all are made whole. Vertices on open boundaries stay, and those of `firm`,
/// ascending; normals turn with the surface and become those of the surface on the seams, and
/// displacements of morph targets make the same steps. Returns how many steps were made.
Index smooth_seams(Mesh& mesh, std::span<const std::vector<Index>> seams,
                   std::span<const Index> firm, const SeamSmoothing& how, const Context& context);

}  // namespace lissom
