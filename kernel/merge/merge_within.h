/// A merge of a mesh with itself: two of its boundaries are joined.
#pragma once

#include <span>

#include "kernel/core/context.h"
#include "kernel/merge/merge.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Joins boundaries of one mesh by `bridge`: nothing is deformed, and all vertices stay. Both
/// boundaries of a join lie on `mesh`, and each is in one join. In the result the faces of the mesh
/// are the target's and the triangles of the bridges the source's; a triangle comes from the face
/// at its boundary edge, its corners from nowhere. Each join makes two seams: the target's boundary
/// and the source's. The report measures them, and the boundaries before. `find_intersections`
/// looks for faces that run through the bridges.
/// Errors: invalid_argument without joins, or for a join with keys or another target than 0; as
/// `bridge`.
MergeResult merge_within(const Mesh& mesh, std::span<const Join> joins,
                         bool find_intersections = true, const Context& context = {});

}  // namespace lissom
