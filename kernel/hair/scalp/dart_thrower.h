/// Poisson disk sampling of a scalp; private to kernel/hair.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/hair/scalp/root_surface.h"
#include "kernel/hair/scalp/roots.h"

namespace lissom {

/// Roots without their normals, for RootPattern::poisson.
std::vector<Root> throw_darts(const RootSurface& surface, const RootOptions& options,
                              const Context& context);

}  // namespace lissom
