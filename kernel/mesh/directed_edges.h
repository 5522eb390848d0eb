/// DirectedEdges: the edges of faces that need not be a manifold; private to kernel/mesh.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// The directed edges of all faces, grouped by the two vertices they join. Corner c stands for the
/// edge from its vertex to the next vertex of its face. Refers to the faces it was made of.
class DirectedEdges {
  public:
    DirectedEdges(Index vertex_count, const FaceList& faces);

    Index low(Index c) const { return std::min(vertices_[at(c)], next_[at(c)]); }
    Index high(Index c) const { return std::max(vertices_[at(c)], next_[at(c)]); }
    /// Returns whether the corner's edge runs from its lower vertex to its higher one.
    bool ascending(Index c) const { return vertices_[at(c)] < next_[at(c)]; }

    /// Calls use(corners) once for each undirected edge, with the corners that run along it, in
    /// ascending order.
    template <typename Use>
    void for_each_edge(const Use& use) const {
        for (std::size_t v = 0; v + 1 < begin_.size(); ++v) {
            for (Index i = begin_[v], j = i; i < begin_[v + 1]; i = j) {
                while (j < begin_[v + 1] && high(corner_[at(j)]) == high(corner_[at(i)])) ++j;
                use(std::span<const Index>(corner_.data() + i, at(j - i)));
            }
        }
    }

  private:
    // Sorts the corners from `begin` to `end`, whose edges have one lower vertex.
    void sort_by_high(Index begin, Index end, std::vector<std::uint64_t>& keys);

    // The corners of the edges whose lower vertex is v are those from begin_[v] on in corner_.
    std::vector<Index> begin_, corner_, next_;
    const std::vector<Index>& vertices_;
};

/// Whether two faces have the same vertices in the same cyclic order, or in the opposite one.
enum class Likeness { none, same, reversed };

/// Tells which faces are copies of one another.
class FaceCycles {
  public:
    explicit FaceCycles(const FaceList& faces) : faces_(faces), key_(at(faces.size()), 0) {}

    Likeness compare(Index f, Index g);

    /// Faces that were seen, by their keys.
    using Seen = std::multimap<std::uint64_t, Index>;
    /// Returns whether `f` is the same as a face in `seen`; if not, it is added.
    bool is_copy(Index f, Seen& seen);

  private:
    // A hash of the vertices, the same for both orders; computed when first asked for.
    std::uint64_t key(Index f);

    const FaceList& faces_;
    std::vector<std::uint64_t> key_;
};

}  // namespace lissom
