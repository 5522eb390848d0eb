/// Parts of a mesh: a region, and the mesh without it.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// A mesh taken out of another, with the old ids of its elements.
struct MeshPart {
    Mesh mesh;
    /// For each vertex and face of `mesh`, the old vertex or face. Order is kept.
    std::vector<Index> vertex_map, face_map;
};

/// Returns the faces of `region` (those with all vertices inside) with their vertices, and the
/// region's vertices that have no faces in `mesh` at all. If the faces taken touch at a vertex
/// only, each fan gets a copy of that vertex, after all others. Attributes, labels and named
/// regions are carried. Errors: topology_mismatch; region_empty if the region holds no face;
/// cancelled.
MeshPart extract(const Mesh& mesh, const Region& region, const Context& context = {});

/// Returns the mesh without the faces of `region`, and without those of its vertices that no face
/// is left for: the complement of `extract`, with the same rules. Both keep the vertices on the
/// region's outline. Errors: as extract.
MeshPart remove(const Mesh& mesh, const Region& region, const Context& context = {});

/// Returns the given faces of `mesh`, in any order, repeats allowed, with their vertices, by the
/// same rules. Errors: out_of_range naming the faces; cancelled.
MeshPart extract_faces(const Mesh& mesh, std::span<const Index> faces, const Context& context = {});

}  // namespace lissom
