/// Regions around features that stand on their surface in several places; private to kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/merge/piece/face_set.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Length of a closed loop of vertices.
double outline_length(const Mesh& mesh, std::span<const Index> loop);

/// Loops around the faces that do not run along open boundaries alone, the longest by count first.
/// The set must have no bow-ties.
std::vector<std::vector<Index>> inner_outlines(const FaceSet& set);

/// Adds, to every outside part that touches the set, its small parts: all but the largest one
/// become members. `bounds`, if not null, limits them.
void fill_islands(FaceSet& set, const FaceSet* bounds);

/// Joins the outlines of a connected set, such as those around both feet of a handle, by strips of
/// the surface between them, until one is left: the faces near the shortest way from one outline to
/// the nearest other one outside the set, about as wide as the lesser of both. Returns
/// the faces along the middle of the strips; none where no way leads from one outline to another.
/// Errors: memory_limit; cancelled.
std::vector<Index> join_outlines(const Mesh& mesh, FaceSet& set, const Context& context);

}  // namespace lissom
