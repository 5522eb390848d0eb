/// Crossings that no view from outside shows; private to kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom {

/// Returns for each pair of faces that run through one another whether the surface hides their line
/// of crossing: at most 3 of 100 directions lead from its middle to the outside, as in a closed
/// mouth or within a body that is open at its end.
std::vector<char> hidden_pairs(const Mesh& mesh, std::span<const FacePair> pairs,
                               const Context& context);

}  // namespace lissom
