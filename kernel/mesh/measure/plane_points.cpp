#include "kernel/mesh/measure/plane_points.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lissom {

void PlanePoints::assign(std::span<const Vec2> points) {
    const Index n = count_of(points);
    points_.assign(points.begin(), points.end());
    for (Vec2& p : points_) {
        if (!p.allFinite()) p = Vec2::Zero();
    }
    present_.assign(points.size(), 0);
    leaf_.assign(points.size(), 0);
    order_.resize(points.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::size_t nodes = n > 0 ? 1 : 0;
    // The larger half decides how deep the tree is.
    for (Index largest = n; largest > kLeafSize; largest -= largest / 2) nodes = 2 * nodes + 1;
    nodes_.assign(nodes, {});
    if (n > 0) build(0, 0, n);
}

void PlanePoints::build(std::size_t node, Index first, Index last) {
    Node& built = nodes_[node];
    built = {{points_[at(order_[at(first)])], points_[at(order_[at(first)])]}, first, last, 0};
    for (Index k = first; k < last; ++k) {
        const Vec2& p = points_[at(order_[at(k)])];
        built.box = {built.box.min.cwiseMin(p), built.box.max.cwiseMax(p)};
    }
    if (is_leaf(built)) {
        for (Index k = first; k < last; ++k) leaf_[at(order_[at(k)])] = index_of(node);
        return;
    }
    const Vec2 size = built.box.max - built.box.min;
    const int axis = size.y() > size.x() ? 1 : 0;
    const Index middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](Index a, Index b) { return points_[at(a)][axis] < points_[at(b)][axis]; });
    build(2 * node + 1, first, middle);
    build(2 * node + 2, middle, last);
}

void PlanePoints::set_present(Index i, bool present) {
    if (this->present(i) == present) return;
    present_[at(i)] = present ? 1 : 0;
    const Index change = present ? 1 : -1;
    auto node = static_cast<std::size_t>(leaf_[at(i)]);
    for (; node > 0; node = (node - 1) / 2) nodes_[node].present += change;
    nodes_[0].present += change;
}

}  // namespace lissom
