/// Linear least squares with some of the unknowns known, as the comparison methods need it; private
/// to kernel/thesis.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/solve/sparse/sparse_matrix.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {

/// Minimises sum over rows of weight_r (A_r x - b_r)^2 over the unknowns that are not known. A
/// single weight may be negative as long as the sum cannot be: cotangents of one triangle.
///
///     LeastSquares system(n);
///     system.add(i, 1.0);
///     system.add(j, -1.0);
///     system.end_row(weight);
///     system.factor(known, context);
///     system.solve(b, x, 3, context);
class LeastSquares {
  public:
    /// Unknown k belongs to vertex k / per_vertex, which errors name.
    explicit LeastSquares(Index unknowns, Index per_vertex = 1);

    /// Adds an entry to the row under construction; each column once a row.
    void add(Index column, double coefficient);
    void end_row(double weight);
    Index rows() const { return rows_.rows(); }

    /// Eliminates the unknowns with known[i] != 0 and factors the remaining system.
    /// Errors: not_positive_definite with local vertices as elements; memory_limit; cancelled.
    void factor(std::span<const char> known, const Context& context);

    /// Solves for `columns` right-hand sides, stored one after the other. `x` holds the known
    /// values and receives the others; an empty `b` is zero.
    void solve(std::span<const double> b, std::span<double> x, Index columns,
               const Context& context) const;

    const std::vector<Index>& free_unknowns() const { return free_; }
    const FactorStats& stats() const { return system_.stats(); }

  private:
    std::vector<double> weighted_residual(std::span<const double> b,
                                          std::span<const double> x) const;
    void transpose();
    void assemble(std::span<const char> known, const Context& context);

    RowMatrix rows_;
    std::vector<double> weight_;
    /// Rows and coefficients of each unknown.
    RowMatrix columns_;
    std::vector<Index> free_, row_of_;
    Index per_vertex_;
    SymmetricMatrix matrix_;
    SparseSystem system_;
};

}  // namespace lissom
