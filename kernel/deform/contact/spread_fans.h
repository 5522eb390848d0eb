/// Vertices whose faces spread around them without meeting; private to kernel/deform.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/deform/contact/local_shape.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Sets `spread` of each of `vertices` to 1 if its faces, seen along their mean normal, lie side by
/// side with angles to spare: then no two of them meet elsewhere than at their common vertices. A
/// vertex with a larger polygon than a quad, or with edges that are short for single precision,
/// gets 0. Errors: cancelled.
void find_spread_fans(const Topology& topology, const LocalShape& shape,
                      std::span<const Index> vertices, std::vector<char>& spread,
                      const Context& context);

}  // namespace lissom
