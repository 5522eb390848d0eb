/// Dense loops of a supernodal factorisation, in registers; private to kernel/solve. Matrices are
/// column-major; a stride is the distance between columns.
#pragma once

#include <cstddef>

#include "kernel/core/geometry.h"

namespace lissom {

/// Columns that one panel of a block holds at most.
inline constexpr Index kPanelColumns = 64;
/// Entries of scratch that the kernels need.
inline constexpr std::size_t kPackedSize = std::size_t{kPanelColumns} * 128;

/// c = -a b^T, or c -= a b^T with `accumulate`: a has `rows` rows, b has `columns` rows (at most
/// kPanelColumns), and both have `depth` columns.
struct DenseProduct {
    const double* a = nullptr;
    const double* b = nullptr;
    double* c = nullptr;
    /// Strides of a and b (parts of one block or of two with one stride), and of c.
    std::ptrdiff_t stride = 0, c_stride = 0;
    Index rows = 0, columns = 0, depth = 0;
    /// Rows that may be read above the first row of a.
    Index above = 0;
    bool accumulate = false;
    double* packed = nullptr;
    /// Stride of b, if it is not that of a.
    std::ptrdiff_t b_stride = 0;
};

/// Columns [first, first + columns) of a block; at most kPanelColumns.
struct DensePanel {
    double* block = nullptr;
    std::ptrdiff_t stride = 0;
    Index first = 0, columns = 0;
    double* packed = nullptr;

    double* entry(Index row, Index column) const { return block + row + column * stride; }
};

/// The loops, compiled for one kind of processor.
struct DenseKernels {
    void (*multiply)(const DenseProduct&);
    /// Cholesky factorisation of the square part of a panel: rows with the numbers of its columns.
    /// Returns the column with a pivot that is not positive, or kNoIndex.
    Index (*eliminate)(const DensePanel&);
    /// Solves X L^T = B in place for the rows [begin, end) below that square part L.
    void (*solve_rows)(const DensePanel&, Index begin, Index end);
};

/// Kinds of processors, each with the features of those before it. The results of the last two are
/// equal to the bit.
enum class Processor { any, avx2, avx512 };

/// Returns the last kind of Processor that this machine has.
Processor best_processor();
/// Returns the kernels for `processor`, which must be a kind that this machine has.
DenseKernels dense_kernels(Processor processor);

}  // namespace lissom
