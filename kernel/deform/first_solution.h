/// The first system by its factor; private to kernel/deform and its tests.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/deformer.h"

namespace lissom {

/// Returns the preview of a Deformer, solved by the factor instead of the basis.
/// Errors: as Deformer::prepare; unsupported for a comparison method.
std::vector<Vec3> solve_first_directly(Deformer& deformer, const Context& context = own_context());

}  // namespace lissom
