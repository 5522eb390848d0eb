/// ConstraintRows: the constraints of a grid in the order in which a dual system holds them;
/// private to kernel/solve.
#pragma once

#include <span>
#include <vector>

#include "kernel/solve/grid/grid_constraints.h"

namespace lissom {

/// What the matrix of a dual system depends on: the grid points that are constrained, each once,
/// and their weights.
struct ConstraintRows {
    std::vector<GridPoint> point;
    std::vector<double> weight;

    std::size_t size() const { return point.size(); }
    /// Rows at the front that are the same in both.
    Index common(const ConstraintRows& other) const;
};

/// The order of `merged` (ascending by point) for a system that holds `old` so far: order[i] is
/// where row i stands in merged. Where every old row is still there, new ones are put behind them.
/// Else the rows of owners edited after `stamp` come last, so that the next edit of the same owner
/// leaves all rows before them alone.
std::vector<Index> arrange_rows(const ConstraintRows& old, const GridSize& size,
                                std::span<const MergedConstraint> merged, std::uint64_t stamp);

/// The rows of `merged` in that order.
ConstraintRows rows_in_order(const GridSize& size, std::span<const MergedConstraint> merged,
                             std::span<const Index> order);

}  // namespace lissom
