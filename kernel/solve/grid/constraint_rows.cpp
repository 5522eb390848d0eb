#include "kernel/solve/grid/constraint_rows.h"

#include <algorithm>

namespace lissom {
namespace {

// Where `point` stands in `merged`, or kNoIndex.
Index find_point(std::span<const MergedConstraint> merged, Index point) {
    const auto at = std::lower_bound(
        merged.begin(), merged.end(), point,
        [](const MergedConstraint& constraint, Index p) { return constraint.point < p; });
    if (at == merged.end() || at->point != point) return kNoIndex;
    return static_cast<Index>(at - merged.begin());
}

}  // namespace

Index ConstraintRows::common(const ConstraintRows& other) const {
    const std::size_t most = std::min(size(), other.size());
    std::size_t i = 0;
    while (i < most && point[i] == other.point[i] && weight[i] == other.weight[i]) ++i;
    return static_cast<Index>(i);
}

std::vector<Index> arrange_rows(const ConstraintRows& old, const GridSize& size,
                                std::span<const MergedConstraint> merged, std::uint64_t stamp) {
    std::vector<Index> kept, order;
    std::vector<bool> taken(merged.size(), false);
    for (std::size_t i = 0; i < old.size(); ++i) {
        const Index at = find_point(merged, size.index(old.point[i]));
        if (at == kNoIndex || merged[at].weight != old.weight[i]) continue;
        kept.push_back(at);
        taken[at] = true;
    }
    const auto edited = [&](Index at) { return merged[at].stamp > stamp; };
    if (kept.size() == old.size()) {
        order = kept;
    } else {
        for (const Index at : kept) {
            if (!edited(at)) order.push_back(at);
        }
        for (const Index at : kept) {
            if (edited(at)) order.push_back(at);
        }
    }
    const std::size_t before = order.size();
    for (std::size_t at = 0; at < merged.size(); ++at) {
        if (!taken[at]) order.push_back(static_cast<Index>(at));
    }
    std::stable_sort(order.begin() + static_cast<std::ptrdiff_t>(before), order.end(),
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
