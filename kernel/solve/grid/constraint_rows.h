/// ConstraintRows: the constraints of a grid in the order in which a dual system holds them;
/// private to kernel/solve.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/solve/grid/grid_constraints.h"
#include "kernel/solve/grid/grid_size.h"

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

/// The order of `merged` (ascending by point) in a system: order[i] is where row i stands in
/// merged. Rows ascend by stamp, then by point: those of the owner that was edited last come last,
/// so that its next edit leaves all rows before them alone. The order follows from the constraints
/// and not from what the system held before.
std::vector<Index> arrange_rows(std::span<const MergedConstraint> merged);

/// The rows of `merged` in that order.
ConstraintRows rows_in_order(const GridSize& size, std::span<const MergedConstraint> merged,
                             std::span<const Index> order);

}  // namespace lissom
