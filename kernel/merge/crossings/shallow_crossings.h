/// Crossings that do not show, since the surfaces hardly pass through one another; private to
/// kernel/merge.
#pragma once

#include <span>

#include "kernel/core/context.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/self_intersections.h"

namespace lissom {

/// Returns whether pairs of faces that run through one another part if the surfaces around them
/// draw back along their normals by at most `depth`, to one side or the other. Other pairs around
/// them may go on to cross. Errors: out_of_range; cancelled.
bool is_shallow(const Mesh& mesh, std::span<const FacePair> pairs, double depth,
                const Context& context);

}  // namespace lissom
