/// Sparse matrices as plain compressed arrays.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "kernel/core/extended.h"
#include "kernel/core/geometry.h"

namespace lissom {

/// Compressed sparse rows. Columns within a row ascend.
struct RowMatrix {
    Index columns = 0;
    std::vector<Index> begin{0};
    std::vector<Index> column;
    std::vector<double> value;

    Index rows() const { return count_of(begin) - 1; }
    std::size_t nonzeros() const { return value.size(); }
};

/// A symmetric matrix, stored as the part on and below the diagonal: compressed columns, rows
/// ascending within a column, the diagonal entry first and always present.
struct SymmetricMatrix {
    std::vector<Index> begin{0};
    std::vector<Index> row;
    std::vector<double> value;

    Index size() const { return count_of(begin) - 1; }
    std::size_t nonzeros() const { return value.size(); }
    /// y = A x for `columns` column vectors stored one after the other.
    void multiply(const double* x, double* y, Index columns) const;
    /// r = b - A x, summed in extended precision.
    void residual(const Extended* b, const double* x, double* r, Index columns) const;
};

/// One entry (row, column, value) of a matrix under construction.
struct Triplet {
    Index row = 0, column = 0;
    double value = 0.0;
};

/// Sums repeated entries; entries above the diagonal are dropped, missing diagonal entries become
/// zero. Errors: out_of_range.
SymmetricMatrix symmetric_from_triplets(Index size, const std::vector<Triplet>& entries);

}  // namespace lissom
