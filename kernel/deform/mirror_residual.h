/// Deviation of a shape from symmetry at handles with a mirror image; private to kernel/deform.
#pragma once

#include "kernel/deform/holds/constraint_set.h"
#include "kernel/deform/options.h"
#include "kernel/deform/rest_shape.h"

namespace lissom {

/// Returns the distances of the reflected vertices and points of a handle from the rest shape.
MirrorResidual residual_of(const RestShape& rest, const Handle& handle);

}  // namespace lissom
