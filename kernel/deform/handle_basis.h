/// The first system's solution as a linear function of the handles' transforms.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/deformer.h"
#include "kernel/deform/options.h"

namespace lissom {

/// x_v = fixed_v + sum_h [linear_h translation_h] * weight(h, v), with `weight` a 4-vector.
struct HandleBasis {
    /// Vertices of the region, ascending; one row of the basis each.
    std::vector<Index> vertices;
    std::vector<HandleId> handles;
    /// For each handle, in the order of `handles`, one 4-vector a row.
    std::vector<std::vector<Vec4>> weights;
    /// Part that no handle moves: pins outside the region, and constraints.
    std::vector<Vec3> fixed;
};

/// Returns the basis of the present handles and constraints. Errors: as Deformer::prepare;
/// unsupported for a comparison method.
HandleBasis basis_of(Deformer& deformer, const Context& context = own_context());

}  // namespace lissom
