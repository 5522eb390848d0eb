/// A strip of triangles between two open boundaries of one mesh: a tube, a tunnel or a handle.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/path.h"

namespace lissom {

/// The faces of a bridge: [first_face, first_face + face_count).
struct BridgeReport {
    Index first_face = 0, face_count = 0;
    /// For each of them the face at its boundary edge.
    std::vector<Index> beside;
};

/// Joins two open boundaries of `mesh`, in place, by triangles between their vertices, one for each
/// edge of either. The boundaries are turned against one another until their points, by arc length,
/// lie closest; from there on the strip has the least sum of squares of its edges across and of the
/// differences in arc length. Existing edges are not used again. All ids stay; the triangles follow
/// the others and face as their neighbours do. The topology is a new one; named regions move to it.
/// A triangle has the attributes and labels of the face at its boundary edge, its corners have
/// the values that its vertices have in the faces at the boundaries.
/// Errors: topology_mismatch; not_a_boundary for a path that is no open boundary of the mesh;
/// boundary_conflict naming vertices if both are the same boundary, or if edges of the mesh between
/// them leave no strip; inconsistent_orientation if the surfaces at the boundaries face opposite
/// sides, so that a tube between them would have one side only; memory_limit; cancelled. The mesh
/// is then unchanged.
BridgeReport bridge(Mesh& mesh, const Path& a, const Path& b, const Context& context = {});

}  // namespace lissom
