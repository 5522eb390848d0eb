/// Finding strands by their roots and by their course. Lists ascend; `select` (strand_edit.h) makes
/// strands of them.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Returns the strands rooted on a face of `region`, which is one of the head that they grew on.
/// Errors: invalid_argument if no faces of roots are known, or one is not a face of the region's
/// mesh.
std::vector<Index> strands_rooted_in(const Strands& strands, const Region& region);

/// Returns the strands that come nearer to a curve than `radius`; both in the unit of the strands.
/// The same for any number of threads. Errors: as require_curve; invalid_argument for a radius that
/// is not 0 or more; cancelled.
std::vector<Index> strands_near_curve(const Strands& strands, std::span<const Vec3> curve,
                                      double radius, const Context& context = {});

}  // namespace lissom
