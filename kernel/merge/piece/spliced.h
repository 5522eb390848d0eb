/// A mesh made of elements of two others; private to kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// The elements of a mesh to be made. Those of the first of two meshes have its numbers, those of
/// the second follow on them.
struct SplicedElements {
    std::vector<Index> vertices, faces;
    /// For each vertex of both its number in the new mesh.
    std::vector<Index> number;
};

/// Returns the mesh of these elements, with the attributes of both: texture coordinates and
/// tangents of vertices become those of corners, as two charts must not be averaged. Its asset is
/// that of `second`. Faces of both that share an edge must do so as a manifold: edges are paired,
/// not checked. Errors: as require_complete_attributes; memory_limit; cancelled.
Mesh spliced(const Mesh& first, const Mesh& second, const SplicedElements& elements,
             const Context& context);

/// Makes texture coordinates and tangents of vertices those of corners.
void split_charts(Mesh& mesh);

}  // namespace lissom
