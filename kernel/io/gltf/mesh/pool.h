/// VertexPool: the vertices of one glTF mesh: for a vertex of the surface as many as its
/// corners have different values; private to kernel/io.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/mesh/attributes.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Pool vertices in the order of the surface's vertices, and of its corners at each of them.
struct VertexPool {
    /// For each pool vertex, the vertex of the mesh, and one of the corners that it stands for
    /// (kNoIndex for a vertex without faces).
    std::vector<Index> vertices, corners;

    std::size_t size() const { return vertices.size(); }
    /// Returns the value of an attribute of vertices or corners at pool vertex `i`.
    std::span<const double> value(const Attribute& attribute, std::size_t i) const {
        return attribute.at(attribute.domain == Domain::vertex ? vertices[i] : corners[i]);
    }
};

/// Pools of the faces of a mesh. `pool_of_face` gives the pool of every face; `split_by` are
/// attributes of corners. Corners with values that are equal as 32-bit numbers share a vertex.
class VertexPools {
  public:
    VertexPools(const Mesh& mesh, const std::vector<Index>& pool_of_face, Index pool_count,
                const std::vector<const Attribute*>& split_by);

    const VertexPool& pool(Index i) const { return pools_[i]; }
    /// Returns the vertex of its pool that stands for a corner of the mesh.
    Index vertex_of_corner(Index corner) const { return vertex_of_corner_[corner]; }

  private:
    Index find_or_add(VertexPool& pool, Index vertex, Index corner, std::size_t first,
                      const std::vector<const Attribute*>& split_by);

    std::vector<VertexPool> pools_;
    std::vector<Index> vertex_of_corner_;
};

/// Returns true if vertices that are open or stand for several lie at one place, so that places do
/// not tell which vertices of a pool are one.
bool seams_are_ambiguous(const Mesh& mesh, const VertexPools& pools, Index pool_count);

/// Returns all vertices of a mesh without faces.
VertexPool pool_of_points(const Mesh& mesh);

}  // namespace lissom
