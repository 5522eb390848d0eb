/// Fairing: the smoothest shape of a part of a surface that continues what is around it. Private to
/// kernel/mesh.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Moves the vertices of `region`: first to a membrane (uniform weights), which spreads them
/// without folds, then to a thin plate over it (cotangent weights), which meets the surface around
/// at its tangents. Each connected part of the region needs a neighbour outside it.
/// Errors: not_positive_definite; memory_limit; cancelled. The mesh is then unchanged.
void fair(Mesh& mesh, const Region& region, const Context& context = {});

}  // namespace lissom
