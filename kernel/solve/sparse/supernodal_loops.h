/// Loops of triangular solves over the supernodes of a Cholesky factor; private to kernel/solve.
/// They are compiled twice, as kernel/core/lanes.h says.
#pragma once

#include <cstddef>

#include "kernel/core/geometry.h"
#include "kernel/core/lanes.h"

namespace lissom {

/// A supernodal factor L. Supernode s holds the columns super[s] ..
/// super[s + 1] - 1 as one dense column-major block at value[first_value[s]]; its rows are
/// row[first_row[s]] .. row[first_row[s + 1] - 1]; the first of them are those columns.
template <typename Real>
struct SupernodalView {
    const Index* super = nullptr;
    const Index* first_row = nullptr;
    const Index* first_value = nullptr;
    const Index* row = nullptr;
    const Real* value = nullptr;
};

/// One supernode as a dense block.
template <typename Real>
struct SupernodeBlock {
    Index first, columns, height;
    const Index* row;
    const Real* value;

    LISSOM_INLINE SupernodeBlock(const SupernodalView<Real>& f, Index s)
        : first(f.super[s]),
          columns(f.super[s + 1] - f.super[s]),
          height(f.first_row[s + 1] - f.first_row[s]),
          row(f.row + f.first_row[s]),
          value(f.value + f.first_value[s]) {}

    LISSOM_INLINE const Real* column(Index j) const {
        return value + static_cast<std::ptrdiff_t>(j) * height;
    }
};

/// below[i] += sum over j of L(columns + i, j) own[j]; four columns of the block at a time, each
/// read in its own order.
template <typename Real>
LISSOM_INLINE void multiply_below(const SupernodeBlock<Real>& block, const Lanes<Real>* own,
                                  Lanes<Real>* below) {
    const Index rows = block.height - block.columns;
    Index j = 0;
    for (; j + 3 < block.columns; j += 4) {
        const Real* a = block.column(j) + block.columns;
        const Real *b = a + block.height, *c = b + block.height, *d = c + block.height;
        const Lanes<Real> xa = own[j], xb = own[j + 1], xc = own[j + 2], xd = own[j + 3];
        for (Index i = 0; i < rows; ++i) {
            Lanes<Real> sum = below[i];
            sum += a[i] * xa;
            sum += b[i] * xb;
            sum += c[i] * xc;
            sum += d[i] * xd;
            below[i] = sum;
        }
    }
    for (; j < block.columns; ++j) {
        const Real* a = block.column(j) + block.columns;
        const Lanes<Real> x = own[j];
        for (Index i = 0; i < rows; ++i) below[i] += a[i] * x;
    }
}

/// own[j] -= sum over i of L(columns + i, j) below[i].
template <typename Real>
LISSOM_INLINE void subtract_transposed(const SupernodeBlock<Real>& block, const Lanes<Real>* below,
                                       Lanes<Real>* own) {
    const Index rows = block.height - block.columns;
    Index j = 0;
    for (; j + 3 < block.columns; j += 4) {
        const Real* a = block.column(j) + block.columns;
        const Real *b = a + block.height, *c = b + block.height, *d = c + block.height;
        Lanes<Real> sum_a{}, sum_b{}, sum_c{}, sum_d{};
        for (Index i = 0; i < rows; ++i) {
            const Lanes<Real> x = below[i];
            sum_a += a[i] * x;
            sum_b += b[i] * x;
            sum_c += c[i] * x;
            sum_d += d[i] * x;
        }
        own[j] -= sum_a;
        own[j + 1] -= sum_b;
        own[j + 2] -= sum_c;
        own[j + 3] -= sum_d;
    }
    for (; j < block.columns; ++j) {
        const Real* a = block.column(j) + block.columns;
        Lanes<Real> sum{};
        for (Index i = 0; i < rows; ++i) sum += a[i] * below[i];
        own[j] -= sum;
    }
}

/// L x = b for the columns of supernode s; `below` is scratch as long as its rows.
template <typename Real>
LISSOM_INLINE void solve_lower(const SupernodalView<Real>& factor, Index s, Lanes<Real>* x,
                               Lanes<Real>* below) {
    const SupernodeBlock<Real> block(factor, s);
    Lanes<Real>* own = x + block.first;
    for (Index j = 0; j < block.columns; ++j) {
        const Real* column = block.column(j);
        const Lanes<Real> solved = (Real{1} / column[j]) * own[j];
        own[j] = solved;
        for (Index i = j + 1; i < block.columns; ++i) own[i] -= column[i] * solved;
    }
    const Index rows = block.height - block.columns;
    for (Index i = 0; i < rows; ++i) below[i] = Lanes<Real>{};
    multiply_below(block, own, below);
    for (Index i = 0; i < rows; ++i) x[block.row[block.columns + i]] -= below[i];
}

/// L^T x = b for the columns of supernode s.
template <typename Real>
LISSOM_INLINE void solve_upper(const SupernodalView<Real>& factor, Index s, Lanes<Real>* x,
                               Lanes<Real>* below) {
    const SupernodeBlock<Real> block(factor, s);
    Lanes<Real>* own = x + block.first;
    const Index rows = block.height - block.columns;
    for (Index i = 0; i < rows; ++i) below[i] = x[block.row[block.columns + i]];
    subtract_transposed(block, below, own);
    for (Index j = block.columns; j-- > 0;) {
        const Real* column = block.column(j);
        Lanes<Real> sum = own[j];
        for (Index i = j + 1; i < block.columns; ++i) sum -= column[i] * own[i];
        own[j] = (Real{1} / column[j]) * sum;
    }
}

}  // namespace lissom
