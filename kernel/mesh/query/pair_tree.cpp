#include "kernel/mesh/query/pair_tree.h"

#include <algorithm>

namespace lissom {
namespace {

constexpr Index kPairLeafSize = 4;

}  // namespace

void PairTree::reserve(std::size_t items, std::size_t boxes) {
    centers_.reserve(boxes);
    items_.reserve(items);
    // Leaves of more than one item have at least half as many as one holds.
    nodes_.reserve(std::max<std::size_t>(items, 1));
}

void PairTree::build(std::span<const Box> boxes, std::span<const Index> items) {
    boxes_ = boxes;
    centers_.clear();
    for (const Box& box : boxes) centers_.push_back(box.center());
    items_.assign(items.begin(), items.end());
    nodes_.clear();
    if (!items_.empty()) build_node(0, count_of(items_));
}

Index PairTree::build_node(Index begin, Index end) {
    const auto node_at = count_of(nodes_);
    nodes_.push_back({{}, begin, end});
    Box box, centers;
    for (Index i = begin; i < end; ++i) {
        const Index item = items_[at(i)];
        box.extend(boxes_[at(item)].min);
        box.extend(boxes_[at(item)].max);
        centers.extend(centers_[at(item)]);
    }
    nodes_[at(node_at)].box = box;
    if (end - begin <= kPairLeafSize) return node_at;
    int axis = 0;
    (centers.max - centers.min).maxCoeff(&axis);
    const Index middle = begin + (end - begin) / 2;
    std::nth_element(items_.begin() + begin, items_.begin() + middle, items_.begin() + end,
                     [&](Index a, Index b) {
                         const double x = centers_[at(a)][axis], y = centers_[at(b)][axis];
                         return x != y ? x < y : a < b;
                     });
    build_node(begin, middle);
    const Index second = build_node(middle, end);
    nodes_[at(node_at)].second = second;
    return node_at;
}

}  // namespace lissom
