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

/// Constraints that determine the matrix of a dual system: the constrained grid points, each once,
/// and their weights.
struct ConstraintRows {
    std::vector<GridPoint> point;
    std::vector<double> weight;

    std::size_t size() const { return point.size(); }
    /// Rows at the front that are the same in both.
    Index common(const ConstraintRows& other) const;
};

/// Returns the order of `merged` (ascending by point) in a system: order[i] is the position of row
/// i in merged. Rows ascend by stamp, then by point: those of the owner that was edited last come
/// last, so that its next edit leaves all rows before them alone. The order follows from the
/// constraints alone, for any history of the system.
std::vector<Index> arrange_rows(std::span<const MergedConstraint> merged);

/// Returns the rows of `merged` in that order.
ConstraintRows rows_in_order(const GridSize& size, std::span<const MergedConstraint> merged,
                             std::span<const Index> order);

}  // namespace lissom
