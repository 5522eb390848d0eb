/// Targets opened for transition regions that overlap, as in the thesis (section 3.3.3):
/// the source's connectivity is kept in the overlap of both regions; private to
/// kernel/thesis.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/merge/blend/overlap_transition.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Takes the regions of all `loops`, each as make_thesis_band, out of a target. The enclosed part,
/// such as the tip of a bump, goes with it.
/// Errors: invalid_argument if a region is no band or touches itself or another; cancelled.
OpenedForOverlap open_for_overlap(const Mesh& target, std::span<const std::vector<Index>> loops,
                                  double width, const Context& context);

}  // namespace lissom
