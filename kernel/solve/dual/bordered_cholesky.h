/// BorderedCholesky: a dense Cholesky factor that can lose its last rows and gain new ones; private
/// to kernel/solve.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

#include "kernel/core/context.h"
#include "kernel/core/index.h"

namespace lissom {

/// The factor L of a dense symmetric positive definite matrix, M = L L^T. Rows that stay at the
/// front keep their part of the factor: m new rows below k old ones cost k^2 m, not (k + m)^3 / 3.
/// The factor is the same to the bit for any history of rows.
class BorderedCholesky {
  public:
    /// Writes the entries of column `column` of M in the rows [begin, end) to `entries`, the first
    /// of them in row begin. Called from several threads.
    using Fill = std::function<void(Index column, Index begin, Index end, double* entries)>;

    Index size() const { return size_; }
    /// Bytes of the factor of `size` rows.
    static std::size_t bytes(Index size);

    /// Forgets all rows from `size` on, and their columns.
    void truncate(Index size);
    /// Adds rows until there are `size`. After an error no new row is there, and of the old ones
    /// those of whole panels.
    /// Errors: not_positive_definite; memory_limit; cancelled.
    void extend(Index size, const Fill& fill, const Context& context);
    /// Solves M x = b in place for four right-hand sides, four numbers a row.
    void solve(double* values) const;

  private:
    void reserve(Index size, const Context& context);
    void fill_rows(Index size, const Fill& fill, const Context& context);
    void border_old_columns(Index size, const Context& context);
    void eliminate_new_columns(Index size, const Context& context);
    double* entry(Index row, Index column) const {
        return value_.get() + row + std::ptrdiff_t{column} * stride_;
    }

    Index size_ = 0, stride_ = 0;
    std::unique_ptr<double[]> value_;
    MemoryCharge charge_;
};

}  // namespace lissom
