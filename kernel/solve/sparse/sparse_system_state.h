/// The values that a SparseSystem keeps; private to kernel/solve.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/solve/sparse/factor_plan.h"
#include "kernel/solve/sparse/sparse_matrix.h"
#include "kernel/solve/sparse/sparse_system.h"
#include "kernel/solve/sparse/supernodes.h"

namespace lissom {

/// The part of the unknowns that a matrix has rows for, with the means to find a change of it. The
/// other unknowns have rows of the identity.
struct FactorPart {
    /// Row of each unknown, or kNoIndex; empty if the matrix has all.
    std::vector<Index> row_of;
    Index size = 0;
    /// The matrix over all unknowns that was factored last.
    std::vector<double> value;
    /// Supernodes that the part has no columns of.
    std::vector<char> idle;
    std::unique_ptr<double[]> extensions;

    bool empty() const { return row_of.empty(); }
};

struct SparseSystem::State {
    Supernodes nodes;
    FactorPlan plan;
    std::unique_ptr<double[]> value;
    FactorPart part;
    /// The row of a solve for each row of the factor, or kNoIndex, and the supernodes with rows.
    std::vector<Index> solve_row, solve_nodes;
    // Buffer of the solve before, taken by the next one; a concurrent solve makes its own.
    std::vector<double> scratch;
    std::mutex scratch_lock;
    std::vector<Index> begin, row;
    bool factored = false;
    // Memory of the analysis and of the values.
    MemoryCharge analysis_charge, charge;
    FactorStats stats;

    /// Number of unknowns analysed.
    Index size() const { return begin.empty() ? 0 : count_of(begin) - 1; }
    void number_solve();
    /// Throws not_positive_definite if a column has failed or a pivot is too small.
    void require_pivots(Index failed, const double* values, const SymmetricMatrix& matrix) const;
};

}  // namespace lissom
