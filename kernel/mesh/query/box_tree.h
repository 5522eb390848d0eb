/// BoxTree: a hierarchy of bounding boxes over numbered items, for queries that concern few of
/// many.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"

namespace lissom {

/// Returns the least box around both.
inline Box united(const Box& a, const Box& b) {
    return {a.min.cwiseMin(b.min), a.max.cwiseMax(b.max)};
}

/// Half the surface of a box; 0 if it is empty.
inline double half_surface(const Box& box) {
    if (box.empty()) return 0.0;
    const Vec3 d = box.max - box.min;
    return d.x() * d.y() + d.y() * d.z() + d.z() * d.x();
}

class BoxTree {
  public:
    /// A leaf has `count` > 0 items, from `first` on in the order of the leaves. The children of
    /// another node are the nodes `first` and `first` + 1, which come after it.
    struct Node {
        Box box;
        Index first = 0, count = 0;
    };

    /// No path from the root to a leaf is as long.
    static constexpr std::size_t kStackSize = 128;

    /// The tree of nothing.
    BoxTree() = default;
    /// A tree of boxes[i] for the items i, by the surface area heuristic over bins (Wald 2007).
    /// Errors: cancelled.
    explicit BoxTree(std::span<const Box> boxes, const Context& context = {});

    /// Gives the items new boxes, box_of(item), and keeps the hierarchy: linear, and queries give
    /// the same answers, but slower if former neighbours move apart (see `wear`).
    template <typename BoxOf>
    void refit(const BoxOf& box_of) noexcept;

    /// Returns how much more a query is expected to cost since the tree was built, by the surface
    /// area heuristic: 1 for a new tree. A new one is worth its time if this is far above 1 and
    /// many queries follow.
    double wear() const { return built_cost_ > 0.0 && cost_ > 0.0 ? cost_ / built_cost_ : 1.0; }

    bool empty() const { return nodes_.empty(); }
    /// The root is node 0.
    const Node& node(Index i) const { return nodes_[at(i)]; }
    std::span<const Index> items(const Node& leaf) const {
        return {order_.data() + leaf.first, at(leaf.count)};
    }
    Box bounds() const { return empty() ? Box{} : nodes_[0].box; }
    std::size_t memory_bytes() const;

    /// Calls visit(item) for all items of the leaves whose boxes, and those above them, enter(box)
    /// accepts.
    template <typename Enter, typename Visit>
    void visit(const Enter& enter, const Visit& visit) const;

  private:
    void build(std::span<const Box> boxes, const Context& context);
    Index split(const Node& node, std::span<const Box> boxes, bool halve);
    /// Returns the contribution of the boxes of the node and of its contents to the cost of a
    /// query.
    static double cost_of(const Node& node) {
        return half_surface(node.box) * (node.count > 0 ? node.count : 2);
    }
    void set_cost(double sum);

    /// Items in the order of the leaves.
    std::vector<Index> order_;
    std::vector<Node> nodes_;
    /// Boxes of nodes and items that a line through the bounds is expected to be tested with.
    double cost_ = 0.0, built_cost_ = 0.0;
};

template <typename BoxOf>
void BoxTree::refit(const BoxOf& box_of) noexcept {
    double sum = 0.0;
    // Children come after their parents.
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        Node& renewed = nodes_[i];
        Box box;
        for (const Index item : items(renewed)) box = united(box, box_of(item));
        if (renewed.count == 0) box = united(node(renewed.first).box, node(renewed.first + 1).box);
        renewed.box = box;
        sum += cost_of(renewed);
    }
    set_cost(sum);
}

template <typename Enter, typename Visit>
void BoxTree::visit(const Enter& enter, const Visit& visit) const {
    std::array<Index, kStackSize> stack;
    std::size_t size = 0;
    if (!empty()) stack[size++] = 0;
    while (size > 0) {
        const Node& top = node(stack[--size]);
        if (!enter(top.box)) continue;
        for (const Index item : items(top)) visit(item);
        if (top.count > 0) continue;
        stack[size++] = top.first + 1;
        stack[size++] = top.first;
    }
}

}  // namespace lissom
