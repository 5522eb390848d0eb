/// The loops behind DenseKernels; private to kernel/solve. They are compiled twice, as
/// kernel/core/lanes.h says.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kernel/core/index.h"
#include "kernel/core/lanes.h"
#include "kernel/solve/sparse/dense_kernels.h"

namespace lissom {

inline constexpr Index kTileColumns = 4, kPackedDepth = 128;
static_assert(kPackedSize == std::size_t{kPanelColumns} * kPackedDepth);

/// Rows of b as strips of four, each strip column by column, filled up with zeros.
LISSOM_INLINE void pack_strips(const double* b, std::ptrdiff_t stride, Index columns, Index depth,
                               double* packed) {
    for (Index j = 0; j < columns; j += kTileColumns) {
        const double* from = b + j;
        if (j + kTileColumns <= columns) {
            for (Index k = 0; k < depth; ++k, from += stride, packed += kTileColumns) {
                *reinterpret_cast<Lanes<double>*>(packed) =
                    *reinterpret_cast<const Lanes<double>*>(from);
            }
            continue;
        }
        for (Index k = 0; k < depth; ++k, from += stride, packed += kTileColumns) {
            for (Index i = 0; i < kTileColumns; ++i) packed[i] = j + i < columns ? from[i] : 0.0;
        }
    }
}

/// Sums of 4 Rows x 4 products of rows of a and one strip of b.
template <int Rows>
LISSOM_INLINE void sum_tile(const double* a, std::ptrdiff_t stride, const double* strip,
                            Index depth, Lanes<double> (&sum)[kTileColumns][Rows]) {
    for (auto& column : sum) {
        for (auto& lanes : column) lanes = Lanes<double>{};
    }
    for (Index k = 0; k < depth; ++k, a += stride, strip += kTileColumns) {
        const auto* lanes = reinterpret_cast<const Lanes<double>*>(a);
        for (int j = 0; j < kTileColumns; ++j) {
            for (int r = 0; r < Rows; ++r) sum[j][r] += strip[j] * lanes[r];
        }
    }
}

/// All columns of c for 4 Rows rows of a.
template <int Rows>
LISSOM_INLINE void multiply_rows(const DenseProduct& p, const double* a, double* c, Index depth,
                                 bool accumulate) {
    Lanes<double> sum[kTileColumns][Rows];
    for (Index j = 0; j < p.columns; j += kTileColumns) {
        sum_tile<Rows>(a, p.stride, p.packed + j * depth, depth, sum);
        const Index columns = std::min(kTileColumns, p.columns - j);
        for (Index i = 0; i < kTileColumns; ++i) {
            if (i >= columns) break;
            auto* to = reinterpret_cast<Lanes<double>*>(c + (j + i) * p.c_stride);
            for (int r = 0; r < Rows; ++r) {
                Lanes<double> value{};
                if (accumulate) value = to[r];
                value -= sum[i][r];
                to[r] = value;
            }
        }
    }
}

/// The last one to three rows: a tile that begins above them, of which only these are kept.
LISSOM_INLINE void multiply_last_rows(const DenseProduct& p, const double* a, double* c, Index rows,
                                      Index depth, bool accumulate) {
    Lanes<double> sum[kTileColumns][1];
    const Index skipped = 4 - rows;
    for (Index j = 0; j < p.columns; j += kTileColumns) {
        sum_tile<1>(a - skipped, p.stride, p.packed + j * depth, depth, sum);
        const Index columns = std::min(kTileColumns, p.columns - j);
        for (Index i = 0; i < kTileColumns; ++i) {
            if (i >= columns) break;
            double* to = c + (j + i) * p.c_stride;
            for (Index r = 0; r < rows; ++r) {
                to[r] = (accumulate ? to[r] : 0.0) - sum[i][0][skipped + r];
            }
        }
    }
}

/// As multiply_last_rows where there are no four rows to read.
LISSOM_INLINE void multiply_few_rows(const DenseProduct& p, const double* a, double* c, Index rows,
                                     Index depth, bool accumulate) {
    for (Index j = 0; j < p.columns; ++j) {
        const double* strip = p.packed + (j - j % kTileColumns) * depth + j % kTileColumns;
        for (Index r = 0; r < rows; ++r) {
            double sum = 0.0;
            for (Index k = 0; k < depth; ++k) sum += strip[k * kTileColumns] * a[r + k * p.stride];
            double& to = c[r + j * p.c_stride];
            to = (accumulate ? to : 0.0) - sum;
        }
    }
}

/// One slice of the depth, whose part of b is packed. `Rows` tiles of four rows at a time.
template <int Rows>
LISSOM_INLINE void multiply_slice(const DenseProduct& p, const double* a, Index depth,
                                  bool accumulate) {
    Index i = 0;
    for (; i + 4 * Rows <= p.rows; i += 4 * Rows) {
        multiply_rows<Rows>(p, a + i, p.c + i, depth, accumulate);
    }
    for (; i + 4 <= p.rows; i += 4) multiply_rows<1>(p, a + i, p.c + i, depth, accumulate);
    if (i == p.rows) return;
    if (p.above + p.rows >= 4) {
        multiply_last_rows(p, a + i, p.c + i, p.rows - i, depth, accumulate);
    } else {
        multiply_few_rows(p, a + i, p.c + i, p.rows - i, depth, accumulate);
    }
}

template <int Rows>
LISSOM_INLINE void multiply_dense(const DenseProduct& p) {
    const std::ptrdiff_t b_stride = p.b_stride != 0 ? p.b_stride : p.stride;
    for (Index k = 0; k < p.depth; k += kPackedDepth) {
        const Index depth = std::min(kPackedDepth, p.depth - k);
        pack_strips(p.b + k * b_stride, b_stride, p.columns, depth, p.packed);
        multiply_slice<Rows>(p, p.a + k * p.stride, depth, p.accumulate || k > 0);
    }
}

/// Subtracts from the columns [at, at + columns) of a panel what its earlier columns give.
template <int Rows>
LISSOM_INLINE void subtract_earlier(const DensePanel& p, Index at, Index columns, Index begin,
                                    Index end) {
    if (at == p.first || begin >= end) return;
    multiply_dense<Rows>({p.entry(begin, p.first), p.entry(at, p.first), p.entry(begin, at),
                          p.stride, p.stride, end - begin, columns, at - p.first, begin, true,
                          p.packed});
}

/// Divides the rows [begin, end) of up to four columns from `at` on by their triangle.
LISSOM_INLINE void divide_rows(const DensePanel& p, Index at, Index columns, Index begin,
                               Index end) {
    for (Index c = 0; c < columns; ++c) {
        double* to = p.entry(0, at + c);
        for (Index k = 0; k < c; ++k) {
            const double factor = *p.entry(at + c, at + k);
            const double* from = p.entry(0, at + k);
            for (Index i = begin; i < end; ++i) to[i] -= factor * from[i];
        }
        const double inverse = 1.0 / to[at + c];
        for (Index i = begin; i < end; ++i) to[i] *= inverse;
    }
}

/// The factor of a block of up to four columns in place.
LISSOM_INLINE Index eliminate_tile(const DensePanel& p, Index at, Index columns) {
    for (Index c = at; c < at + columns; ++c) {
        const double pivot = *p.entry(c, c);
        if (!(pivot > 0.0)) return c;
        const double root = std::sqrt(pivot);
        *p.entry(c, c) = root;
        for (Index i = c + 1; i < at + columns; ++i) *p.entry(i, c) /= root;
        for (Index j = c + 1; j < at + columns; ++j) {
            for (Index i = j; i < at + columns; ++i) {
                *p.entry(i, j) -= *p.entry(i, c) * *p.entry(j, c);
            }
        }
    }
    return kNoIndex;
}

template <int Rows>
LISSOM_INLINE Index eliminate_dense(const DensePanel& p) {
    const Index end = p.first + p.columns;
    for (Index at = p.first; at < end; at += kTileColumns) {
        const Index columns = std::min(kTileColumns, end - at);
        subtract_earlier<Rows>(p, at, columns, at, end);
        const Index failed = eliminate_tile(p, at, columns);
        if (failed != kNoIndex) return failed;
        divide_rows(p, at, columns, at + columns, end);
    }
    return kNoIndex;
}

template <int Rows>
LISSOM_INLINE void solve_rows_dense(const DensePanel& p, Index begin, Index end) {
    const Index last = p.first + p.columns;
    for (Index at = p.first; at < last; at += kTileColumns) {
        const Index columns = std::min(kTileColumns, last - at);
        subtract_earlier<Rows>(p, at, columns, begin, end);
        divide_rows(p, at, columns, begin, end);
    }
}

}  // namespace lissom
