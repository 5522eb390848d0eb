#include "kernel/solve/supernodal_solve.h"

#include <cstddef>

// The loops are written once and compiled twice where the compiler can choose at run time: for any
// processor and for those with AVX2.
#if defined(__GNUC__) && defined(__x86_64__)
#define LISSOM_HAS_AVX2_PATH
#define LISSOM_INLINE inline __attribute__((always_inline))
#else
#define LISSOM_INLINE inline
#endif

namespace lissom {
namespace {

// Four numbers, one a right-hand side.
#if defined(__GNUC__)
using Lanes = double __attribute__((vector_size(32), aligned(8), may_alias));
#else
struct Lanes {
    double v[4];
    Lanes& operator+=(const Lanes& b) {
        for (int c = 0; c < 4; ++c) v[c] += b.v[c];
        return *this;
    }
    Lanes& operator-=(const Lanes& b) {
        for (int c = 0; c < 4; ++c) v[c] -= b.v[c];
        return *this;
    }
    friend Lanes operator*(double a, Lanes b) {
        for (double& x : b.v) x *= a;
        return b;
    }
};
#endif

// One supernode as a dense block.
struct Block {
    Index first, columns, height;
    const Index* row;
    const double* value;

    Block(const SupernodalFactor& f, Index s)
        : first(f.super[s]),
          columns(f.super[s + 1] - f.super[s]),
          height(f.first_row[s + 1] - f.first_row[s]),
          row(f.row + f.first_row[s]),
          value(f.value + f.first_value[s]) {}

    const double* column(Index j) const { return value + static_cast<std::ptrdiff_t>(j) * height; }
};

// below[i] += sum over j of L(columns + i, j) own[j]; four columns of the block at a time, each
// read in its own order.
LISSOM_INLINE void multiply_below(const Block& block, const Lanes* own, Lanes* below) {
    const Index rows = block.height - block.columns;
    Index j = 0;
    for (; j + 3 < block.columns; j += 4) {
        const double* a = block.column(j) + block.columns;
        const double *b = a + block.height, *c = b + block.height, *d = c + block.height;
        const Lanes xa = own[j], xb = own[j + 1], xc = own[j + 2], xd = own[j + 3];
        for (Index i = 0; i < rows; ++i) {
            Lanes sum = below[i];
            sum += a[i] * xa;
            sum += b[i] * xb;
            sum += c[i] * xc;
            sum += d[i] * xd;
            below[i] = sum;
        }
    }
    for (; j < block.columns; ++j) {
        const double* a = block.column(j) + block.columns;
        const Lanes x = own[j];
        for (Index i = 0; i < rows; ++i) below[i] += a[i] * x;
    }
}

// own[j] -= sum over i of L(columns + i, j) below[i].
LISSOM_INLINE void subtract_transposed(const Block& block, const Lanes* below, Lanes* own) {
    const Index rows = block.height - block.columns;
    Index j = 0;
    for (; j + 3 < block.columns; j += 4) {
        const double* a = block.column(j) + block.columns;
        const double *b = a + block.height, *c = b + block.height, *d = c + block.height;
        Lanes sum_a{}, sum_b{}, sum_c{}, sum_d{};
        for (Index i = 0; i < rows; ++i) {
            const Lanes x = below[i];
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
        const double* a = block.column(j) + block.columns;
        Lanes sum{};
        for (Index i = 0; i < rows; ++i) sum += a[i] * below[i];
        own[j] -= sum;
    }
}

LISSOM_INLINE void solve_lower(const SupernodalFactor& factor, Lanes* x, Lanes* below) {
    for (Index s = 0; s < factor.supernodes; ++s) {
        const Block block(factor, s);
        Lanes* own = x + block.first;
        for (Index j = 0; j < block.columns; ++j) {
            const double* column = block.column(j);
            const Lanes solved = (1.0 / column[j]) * own[j];
            own[j] = solved;
            for (Index i = j + 1; i < block.columns; ++i) own[i] -= column[i] * solved;
        }
        const Index rows = block.height - block.columns;
        for (Index i = 0; i < rows; ++i) below[i] = Lanes{};
        multiply_below(block, own, below);
        for (Index i = 0; i < rows; ++i) x[block.row[block.columns + i]] -= below[i];
    }
}

LISSOM_INLINE void solve_upper(const SupernodalFactor& factor, Lanes* x, Lanes* below) {
    for (Index s = factor.supernodes; s-- > 0;) {
        const Block block(factor, s);
        Lanes* own = x + block.first;
        const Index rows = block.height - block.columns;
        for (Index i = 0; i < rows; ++i) below[i] = x[block.row[block.columns + i]];
        subtract_transposed(block, below, own);
        for (Index j = block.columns; j-- > 0;) {
            const double* column = block.column(j);
            Lanes sum = own[j];
            for (Index i = j + 1; i < block.columns; ++i) sum -= column[i] * own[i];
            own[j] = (1.0 / column[j]) * sum;
        }
    }
}

void solve_anywhere(const SupernodalFactor& factor, Lanes* x, Lanes* below) {
    solve_lower(factor, x, below);
    solve_upper(factor, x, below);
}

#ifdef LISSOM_HAS_AVX2_PATH
__attribute__((target("avx2,fma"))) void solve_with_avx2(const SupernodalFactor& factor, Lanes* x,
                                                         Lanes* below) {
    solve_lower(factor, x, below);
    solve_upper(factor, x, below);
}
#endif

}  // namespace

void solve_supernodal(const SupernodalFactor& factor, const double* b, double* x, Index columns,
                      std::vector<double>& scratch) {
    const auto n = static_cast<std::size_t>(factor.size);
    scratch.resize(2 * kSolveWidth * n);
    double* solution = scratch.data();
    for (std::size_t i = 0; i < n; ++i) {
        const auto from = static_cast<std::size_t>(factor.permutation[i]);
        for (Index c = 0; c < kSolveWidth; ++c) {
            solution[i * kSolveWidth + static_cast<std::size_t>(c)] =
                c < columns ? b[static_cast<std::size_t>(c) * n + from] : 0.0;
        }
    }
    auto* lanes = reinterpret_cast<Lanes*>(solution);
#ifdef LISSOM_HAS_AVX2_PATH
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
        solve_with_avx2(factor, lanes, lanes + n);
    } else {
        solve_anywhere(factor, lanes, lanes + n);
    }
#else
    solve_anywhere(factor, lanes, lanes + n);
#endif
    for (std::size_t i = 0; i < n; ++i) {
        const auto to = static_cast<std::size_t>(factor.permutation[i]);
        for (Index c = 0; c < columns; ++c) {
            x[static_cast<std::size_t>(c) * n + to] =
                solution[i * kSolveWidth + static_cast<std::size_t>(c)];
        }
    }
}

}  // namespace lissom
