/// Creases of the parts at rest, which smoothing keeps; private to kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Returns those of `asked` at which an edge of a crease ends, ascending. A crease turns by more
/// than 30 degrees at the edge, and from the mean of the faces around one side of it to that around
/// the other as well: single edges of rough surfaces do not. On an open boundary, the place of a
/// future seam, only creases of clean shapes count: edges beside them that are no creases turn by
/// less than 10 degrees.
std::vector<Index> creased_vertices(const Mesh& mesh, std::span<const Index> asked);

/// Returns the vertices in flat faces of a mesh, ascending: the faces around each turn by less than
/// a twentieth of a degree from each other. The path of an open boundary does not matter.
std::vector<Index> flat_vertices(const Mesh& mesh);

/// Returns the vertices of `loops` and of two rings of faces around them, ascending.
std::vector<Index> vertices_near(const Mesh& mesh, std::span<const std::vector<Index>> loops);

}  // namespace lissom
