/// The loops behind DenseKernels; private to kernel/solve. They are compiled for each kind of
/// processor, as kernel/core/lanes.h says. A `Tile` sets the number of rows computed together: a
/// number `kVectors` of its type `Vector`, four or eight numbers each.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

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
                std::memcpy(packed, from, kTileColumns * sizeof(double));
            }
            continue;
        }
        for (Index k = 0; k < depth; ++k, from += stride, packed += kTileColumns) {
            for (Index i = 0; i < kTileColumns; ++i) packed[i] = j + i < columns ? from[i] : 0.0;
        }
    }
}

/// `Count` vectors for the rows of a tile, of four columns. `Numbers` holds their type, FourDoubles
/// or EightDoubles.
template <typename Numbers, int Count>
struct TileOf {
    using Vector = typename Numbers::Type;
    using OneVector = TileOf<Numbers, 1>;
    static constexpr int kVectors = Count;
    static constexpr Index kWidth = static_cast<Index>(sizeof(Vector) / sizeof(double));
    static constexpr Index kRows = Count * kWidth;
    using Sums = Vector[kTileColumns][Count];
};
/// One vector of four rows.
using FourRows = TileOf<FourDoubles, 1>;

/// Sums of products of a tile's rows of a and one strip of b.
template <typename Tile>
LISSOM_INLINE void sum_tile(const double* a, std::ptrdiff_t stride, const double* strip,
                            Index depth, typename Tile::Sums& sum) {
    using Vector = typename Tile::Vector;
    for (auto& column : sum) {
        for (auto& lanes : column) lanes = Vector{};
    }
    for (Index k = 0; k < depth; ++k, a += stride, strip += kTileColumns) {
        Vector lanes[Tile::kVectors];
        for (int r = 0; r < Tile::kVectors; ++r) {
            std::memcpy(&lanes[r], a + r * Tile::kWidth, sizeof(Vector));
        }
        for (int j = 0; j < kTileColumns; ++j) {
            for (int r = 0; r < Tile::kVectors; ++r) sum[j][r] += strip[j] * lanes[r];
        }
    }
}

/// All columns of c for a tile's rows of a.
template <typename Tile>
LISSOM_INLINE void multiply_rows(const DenseProduct& p, const double* a, double* c, Index depth,
                                 bool accumulate) {
    using Vector = typename Tile::Vector;
    typename Tile::Sums sum;
    for (Index j = 0; j < p.columns; j += kTileColumns) {
        sum_tile<Tile>(a, p.stride, p.packed + j * depth, depth, sum);
        const Index columns = std::min(kTileColumns, p.columns - j);
        for (Index i = 0; i < kTileColumns; ++i) {
            if (i >= columns) break;
            double* to = c + (j + i) * p.c_stride;
            for (int r = 0; r < Tile::kVectors; ++r, to += Tile::kWidth) {
                Vector value{};
                if (accumulate) std::memcpy(&value, to, sizeof value);
                value -= sum[i][r];
                std::memcpy(to, &value, sizeof value);
            }
        }
    }
}

/// The last one to three rows: a tile that begins above them; only these are kept.
LISSOM_INLINE void multiply_last_rows(const DenseProduct& p, const double* a, double* c, Index rows,
                                      Index depth, bool accumulate) {
    FourRows::Sums sum;
    const Index skipped = 4 - rows;
    for (Index j = 0; j < p.columns; j += kTileColumns) {
        sum_tile<FourRows>(a - skipped, p.stride, p.packed + j * depth, depth, sum);
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

/// Works as multiply_last_rows, for fewer than four rows.
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

/// One slice of the depth, with its part of b packed: tiles, then vectors, then four rows.
template <typename Tile>
LISSOM_INLINE void multiply_slice(const DenseProduct& p, const double* a, Index depth,
                                  bool accumulate) {
    using Vector = typename Tile::OneVector;
    Index i = 0;
    for (; i + Tile::kRows <= p.rows; i += Tile::kRows) {
        multiply_rows<Tile>(p, a + i, p.c + i, depth, accumulate);
    }
    for (; i + Vector::kRows <= p.rows; i += Vector::kRows) {
        multiply_rows<Vector>(p, a + i, p.c + i, depth, accumulate);
    }
    if (i + 4 <= p.rows) {
        multiply_rows<FourRows>(p, a + i, p.c + i, depth, accumulate);
        i += 4;
    }
    if (i == p.rows) return;
    if (p.above + p.rows >= 4) {
        multiply_last_rows(p, a + i, p.c + i, p.rows - i, depth, accumulate);
    } else {
        multiply_few_rows(p, a + i, p.c + i, p.rows - i, depth, accumulate);
    }
}

template <typename Tile>
LISSOM_INLINE void multiply_dense(const DenseProduct& p) {
    const std::ptrdiff_t b_stride = p.b_stride != 0 ? p.b_stride : p.stride;
    for (Index k = 0; k < p.depth; k += kPackedDepth) {
        const Index depth = std::min(kPackedDepth, p.depth - k);
        pack_strips(p.b + k * b_stride, b_stride, p.columns, depth, p.packed);
        multiply_slice<Tile>(p, p.a + k * p.stride, depth, p.accumulate || k > 0);
    }
}

/// Subtracts from the columns [at, at + columns) of a panel the products of its earlier columns.
template <typename Tile>
LISSOM_INLINE void subtract_earlier(const DensePanel& p, Index at, Index columns, Index begin,
                                    Index end) {
    if (at == p.first || begin >= end) return;
    multiply_dense<Tile>({p.entry(begin, p.first), p.entry(at, p.first), p.entry(begin, at),
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

/// Returns the factor of a block of up to four columns in place.
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

template <typename Tile>
LISSOM_INLINE Index eliminate_dense(const DensePanel& p) {
    const Index end = p.first + p.columns;
    for (Index at = p.first; at < end; at += kTileColumns) {
        const Index columns = std::min(kTileColumns, end - at);
        subtract_earlier<Tile>(p, at, columns, at, end);
        const Index failed = eliminate_tile(p, at, columns);
        if (failed != kNoIndex) return failed;
        divide_rows(p, at, columns, at + columns, end);
    }
    return kNoIndex;
}

template <typename Tile>
LISSOM_INLINE void solve_rows_dense(const DensePanel& p, Index begin, Index end) {
    const Index last = p.first + p.columns;
    for (Index at = p.first; at < last; at += kTileColumns) {
        const Index columns = std::min(kTileColumns, last - at);
        subtract_earlier<Tile>(p, at, columns, begin, end);
        divide_rows(p, at, columns, begin, end);
    }
}

}  // namespace lissom
