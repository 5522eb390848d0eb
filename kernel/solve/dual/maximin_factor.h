/// MaximinFactor: a sparse factor of the inverse of a dual system's matrix; private to
/// kernel/solve.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/solve/grid/constraint_rows.h"
#include "kernel/solve/grid/grid_green.h"
#include "kernel/solve/grid/grid_size.h"

namespace lissom {

/// An upper triangular U with few entries a column and U U^T close to the inverse of
/// M = G + W^-2 + shift 1 1': the one that minimises the Kullback-Leibler divergence (Schaefer,
/// Katzfuss and Owhadi, "Sparse Cholesky factorization by Kullback-Leibler minimization", 2021).
/// Rows are ordered from coarse to fine: a row's level is the largest cell, of sides 1, 2, 4, ...
/// grid steps, that it represents, which comes close to a maximin order; its column has entries in
/// the nearest rows before it, found in cells of its level and of coarser ones.
class MaximinFactor {
  public:
    /// Bytes for `rows` rows.
    static std::size_t bytes(std::size_t rows);

    /// Computes the factor for `rows`. Columns with unchanged rows are kept. Errors: cancelled,
    /// memory_limit; then the factor is as before.
    void update(const GridGreen& green, const ConstraintRows& rows, const Context& context);
    /// to = U U^T from; both in the order of the rows.
    void apply(std::span<const Vec3> from, std::span<Vec3> to) const;

  private:
    struct Columns {
        /// Grid point and weight of each column, and the row that it stands for.
        std::vector<Index> point, row;
        std::vector<double> weight;
        /// Entries begin[i] to begin[i + 1] of column i: the columns containing them as rows, the
        /// column itself last.
        std::vector<std::size_t> begin{0};
        std::vector<Index> index;
        std::vector<double> value;
    };

    static void fill_pattern(const GridSize& size, const ConstraintRows& rows, Columns& columns,
                             const Context& context);
    void fill_values(const GridGreen& green, Columns& columns, const Context& context) const;
    static Index fill_block(const GridGreen& green, const Columns& columns, Index i,
                            std::vector<GridPoint>& points, double* block);
    std::vector<Index> former_places(const Columns& columns) const;
    bool keep_column(Columns& columns, Index i, std::span<const Index> places) const;

    Columns columns_;
    MemoryCharge charge_;
};

}  // namespace lissom
