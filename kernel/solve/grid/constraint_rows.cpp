#include "kernel/solve/grid/constraint_rows.h"

#include <algorithm>
#include <numeric>

namespace lissom {

Index ConstraintRows::common(const ConstraintRows& other) const {
    const std::size_t most = std::min(size(), other.size());
    std::size_t i = 0;
    while (i < most && point[i] == other.point[i] && weight[i] == other.weight[i]) ++i;
    return index_of(i);
}

std::vector<Index> arrange_rows(std::span<const MergedConstraint> merged) {
    std::vector<Index> order(merged.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](Index a, Index b) { return merged[a].stamp < merged[b].stamp; });
    return order;
}

ConstraintRows rows_in_order(const GridSize& size, std::span<const MergedConstraint> merged,
                             std::span<const Index> order) {
    ConstraintRows rows;
    rows.point.reserve(order.size());
    rows.weight.reserve(order.size());
    for (const Index at : order) {
        rows.point.push_back(size.point(merged[at].point));
        rows.weight.push_back(merged[at].weight);
    }
    return rows;
}

}  // namespace lissom
