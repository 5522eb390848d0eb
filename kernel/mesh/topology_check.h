/// Validation of faces before a Topology is built from them; private to kernel/mesh.
#pragma once

#include <string>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/error.h"
#include "kernel/core/index.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Throws an error that names `elements` between the defect and the remedy.
[[noreturn]] void refuse(ErrorCode code, Elements elements, const std::string& what,
                         const std::string& remedy);

/// Checks that `faces` are an oriented 2-manifold over `vertex_count` vertices and returns, for
/// each corner, the corner that runs along the same edge the other way, or kNoIndex on a boundary.
/// Corner c stands for the directed edge from its vertex to the next vertex of its face. Errors as
/// of Topology::create.
std::vector<Index> check_and_pair_edges(Index vertex_count, const FaceList& faces,
                                        const Context& context);

}  // namespace lissom
