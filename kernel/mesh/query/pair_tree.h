/// A hierarchy of boxes for the search for pairs of triangles; private to kernel/mesh.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"

namespace lissom {

inline bool boxes_overlap(const Box& a, const Box& b) {
    return (a.min.array() <= b.max.array()).all() && (b.min.array() <= a.max.array()).all();
}

/// A hierarchy of boxes over some triangles, halved along the longest side. It can be built again
/// over others in the memory that it has.
class PairTree {
  public:
    /// Takes the memory of a tree over so many of so many boxes.
    void reserve(std::size_t items, std::size_t boxes);

    /// Builds it over `items` of `boxes`, which live as long as the tree is used.
    void build(std::span<const Box> boxes, std::span<const Index> items);

    /// Calls visit(item) for the items whose boxes overlap `box`.
    template <typename Visit>
    void visit(const Box& box, const Visit& visit) const {
        if (!nodes_.empty()) descend(0, box, visit);
    }

  private:
    // The first child of an inner node follows it; `second` is 0 in a leaf.
    struct Node {
        Box box;
        Index begin, end, second = 0;
    };

    Index build_node(Index begin, Index end);

    template <typename Visit>
    void descend(Index node_at, const Box& box, const Visit& visit) const {
        const Node& node = nodes_[at(node_at)];
        if (!boxes_overlap(node.box, box)) return;
        if (node.second > 0) {
            descend(node_at + 1, box, visit);
            descend(node.second, box, visit);
            return;
        }
        for (Index i = node.begin; i < node.end; ++i) {
            const Index item = items_[at(i)];
            if (boxes_overlap(boxes_[at(item)], box)) visit(item);
        }
    }

    std::span<const Box> boxes_;
    std::vector<Vec3> centers_;
    std::vector<Index> items_;
    std::vector<Node> nodes_;
};

}  // namespace lissom
