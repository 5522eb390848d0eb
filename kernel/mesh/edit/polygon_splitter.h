/// Triangles for polygons such that no two of them share a diagonal, and none lies along an edge of
/// the mesh; private to kernel/mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Every polygon is first split as triangulate_polygon does. Polygons that touch along a diagonal
/// are split otherwise, by augmenting paths as in a bipartite matching: a polygon that needs the
/// diagonal of another makes that one look for a new one. For quads this finds a solution wherever
/// there is one; polygons of more than 320 corners are tried in sixteen ways. Polygons without a
/// solution keep their first triangles, and share a diagonal.
class PolygonSplitter {
  public:
    PolygonSplitter(const Topology& topology, std::span<const Vec3> positions,
                    std::span<const Index> polygons);

    /// Triangles of the n-th polygon as local corner numbers.
    std::span<const Triangle> triangles(std::size_t n) const { return splits_[n]; }

  private:
    using Key = std::uint64_t;
    using Split = std::vector<Triangle>;

    Key key_of(std::size_t polygon, Index a, Index b) const;
    template <typename Use>
    void for_each_diagonal(std::size_t polygon, const Split& split, const Use& use) const;
    bool is_edge(Key diagonal) const;
    std::vector<Vec3> points_of(std::size_t polygon) const;

    std::vector<std::size_t> polygons_in_conflict() const;
    void assign(std::size_t polygon, Split split);
    bool place(std::size_t polygon, int depth);
    Split best_split(std::size_t polygon) const;
    Split turned_split(std::size_t polygon) const;
    double diagonal_cost(std::size_t polygon, Index a, Index b) const;

    const Topology& topology_;
    std::span<const Vec3> positions_;
    std::span<const Index> polygons_;
    std::vector<Split> splits_;
    // Polygon of each diagonal, while conflicts are resolved, and the diagonals visited by the
    // present search.
    std::unordered_map<Key, std::size_t> owner_;
    std::unordered_set<Key> visited_;
};

}  // namespace lissom
