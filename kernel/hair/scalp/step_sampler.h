/// Roots in equal steps of two polar angles; private to kernel/hair.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/hair/scalp/root_surface.h"
#include "kernel/hair/scalp/roots.h"
#include "kernel/hair/scalp/scalp.h"

namespace lissom {

/// Returns the roots of RootPattern::steps, without normals, in random order. Errors: region_empty
/// if hardly any direction meets the scalp; cancelled.
std::vector<Root> roots_in_steps(const Scalp& scalp, const RootSurface& surface,
                                 const RootOptions& options, const Context& context);

}  // namespace lissom
