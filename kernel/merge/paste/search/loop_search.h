/// The cheapest loop of edges around a ring (thesis section 3.4.3); private to kernel/merge.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/merge/paste/region/paste_regions.h"
#include "kernel/merge/paste/search/winding_graph.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// The edges of a ring, cut open along a short path from its outer boundary to the inner one. An
/// edge carries how often it crosses the cut from right to left, so that no vertex is doubled.
class LoopSearch {
  public:
    LoopSearch(const Mesh& source, const PasteRegions& regions, const Context& context);

    /// Edges by the vertices of the mesh that they join; costs are given in this order.
    const std::vector<std::pair<Index, Index>>& edges() const { return edges_; }
    /// Number of the edge between two vertices, or kNoIndex.
    Index edge_between(Index a, Index b) const;

    /// Returns the vertices of the closed path with the least cost that runs once around the ring,
    /// counter-clockwise; it visits no vertex twice. Costs are above 0, or infinite for edges that
    /// must not be used. `known` may be a loop whose edges have finite costs; it is returned if
    /// none is cheaper. Empty if there is none. Errors: cancelled.
    ///
    /// By divide and conquer (Reif 1983): no cheaper loop crosses the cheapest one through a vertex
    /// of the cut, so that one divides the ring, and each half is searched with its part of the
    /// cut. Halves keep all of the loop between them. A lower bound of the costs of walks, found
    /// first by one search from all of the cut, leaves out most of the ring and of the cut.
    std::vector<Index> cheapest(std::span<const double> cost, std::span<const Index> known,
                                const Context& context) const;
    std::vector<Index> cheapest(std::span<const double> cost, const Context& context) const {
        return cheapest(cost, {}, context);
    }

  private:
    friend class RingDivision;
    struct Arc {
        Index to = kNoIndex, edge = kNoIndex;
        int turns = 0;
    };
    using Arcs = std::vector<std::vector<Arc>>;
    void find_cut(const Mesh& source, const PasteRegions& regions, const Arcs& arcs);
    void label(const Mesh& source, const PasteRegions& regions, Arcs& arcs);
    void find_faces(const Mesh& source, const PasteRegions& regions);
    Index local(Index vertex) const;

    std::vector<Index> vertices_;
    std::vector<std::pair<Index, Index>> edges_;
    WindingGraph graph_;
    /// Local numbers, from the outer boundary to the inner one.
    std::vector<Index> cut_;
    /// Edges of face f of the ring: face_begin_[f] to face_begin_[f + 1] of face_edges_.
    std::vector<Index> face_begin_, face_edges_;
    /// Faces of the ring left of each edge from its lower vertex to the higher one, and right of
    /// it, or kNoIndex.
    std::vector<std::array<Index, 2>> beside_;
};

}  // namespace lissom
