/// Points of a plane, each present or not, for searches in a part of it; private to the kernel.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"

namespace lissom {

/// A tree that halves the points across the longer side of their box. It keeps its memory from one
/// set of points to the next.
class PlanePoints {
  public:
    struct Box2 {
        Vec2 min, max;
    };

    /// Takes other points, none of them present. Coordinates that are not finite count as 0.
    void assign(std::span<const Vec2> points);

    bool present(Index i) const { return present_[at(i)] != 0; }
    void set_present(Index i, bool present);

    /// Returns a present point that accept(i) accepts, of the boxes that enter(box) accepts, or
    /// kNoIndex. `budget` falls by one for each box entered; the search ends if it is 0.
    template <typename Enter, typename Accept>
    Index find(const Enter& enter, const Accept& accept, std::size_t& budget) const;

  private:
    static constexpr Index kLeafSize = 4;

    /// The children of node i are 2 i + 1 and 2 i + 2.
    struct Node {
        Box2 box;
        Index first = 0, last = 0;
        Index present = 0;
    };

    void build(std::size_t node, Index first, Index last);
    static bool is_leaf(const Node& node) { return node.last - node.first <= kLeafSize; }

    std::vector<Vec2> points_;
    std::vector<Node> nodes_;
    /// Points in the order of the leaves, and the leaf of each point.
    std::vector<Index> order_, leaf_;
    std::vector<char> present_;
};

template <typename Enter, typename Accept>
Index PlanePoints::find(const Enter& enter, const Accept& accept, std::size_t& budget) const {
    std::size_t stack[64], size = 0;
    if (!nodes_.empty()) stack[size++] = 0;
    while (size > 0 && budget > 0) {
        const std::size_t top = stack[--size];
        const Node& node = nodes_[top];
        if (node.present == 0 || !enter(node.box)) continue;
        --budget;
        if (!is_leaf(node)) {
            stack[size++] = 2 * top + 2;
            stack[size++] = 2 * top + 1;
            continue;
        }
        for (Index k = node.first; k < node.last; ++k) {
            const Index i = order_[at(k)];
            if (present(i) && accept(i)) return i;
        }
    }
    return kNoIndex;
}

}  // namespace lissom
