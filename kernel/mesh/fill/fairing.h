/// Fairing: the smoothest shape of a part of a surface that continues its surroundings.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Order of continuity between a faired part and its surroundings.
enum class FairContinuity {
    /// Its tangents: a thin plate, with the least curvature.
    tangents,
    /// Its curvature too: the plate whose curvature changes least. On a round surface a large part
    /// stays round, whereas a thin plate would be flat in its middle.
    curvature,
};

/// Moves the vertices of `region`: first to a membrane (uniform weights), which spreads them
/// without folds, then to a thin plate over it (cotangent weights), which meets the surface around
/// at its tangents. If `curvature` is asked for, they go from there to the shape with the least
/// change of curvature, sum of w_ij |L x_i - L x_j|^2 over edges with the pointwise cotangent
/// Laplacian L; it depends on three rings around. Displacements of morph targets are faired by the
/// last system's weights. Each connected part of the region needs a neighbour outside it. Errors:
/// not_positive_definite; memory_limit; cancelled. The mesh is then unchanged.
void fair(Mesh& mesh, const Region& region, FairContinuity continuity = FairContinuity::tangents,
          const Context& context = {});

}  // namespace lissom
