/// Merges in one call.
///
///     const MergeResult result = merge(head, body);  // the nearest boundaries
///     const MergeResult other = merge(head, body, {{boundary(head), boundary(body)}});
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/merge/merge.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Returns the join of the boundaries of both meshes that lie nearest to each other: the least mean
/// distance from the vertices of either to those of the other. Errors: not_a_boundary if a mesh is
/// closed; cancelled.
Join nearest_join(const Mesh& source, const Mesh& target, const Context& context = {});

/// Merges a source with one target. Without joins their nearest boundaries meet. Errors: as
/// nearest_join, Merger and Merger::solve.
MergeResult merge(const Mesh& source, const Mesh& target, std::vector<Join> joins = {},
                  const MergeOptions& options = {}, const Context& context = {});

}  // namespace lissom
