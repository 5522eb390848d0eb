#include "kernel/solve/sparse/supernodal_solve.h"

#include <cstddef>

namespace lissom {
namespace {

LISSOM_INLINE void solve_both(const SupernodalFactor& factor, Lanes<double>* x,
                              Lanes<double>* below) {
    for (const Index s : factor.supernodes) solve_lower(factor.view, s, x, below);
    for (std::size_t i = factor.supernodes.size(); i-- > 0;) {
        solve_upper(factor.view, factor.supernodes[i], x, below);
    }
}

void solve_anywhere(const SupernodalFactor& factor, Lanes<double>* x, Lanes<double>* below) {
    solve_both(factor, x, below);
}

#ifdef LISSOM_HAS_AVX2_PATH
LISSOM_AVX2 void solve_with_avx2(const SupernodalFactor& factor, Lanes<double>* x,
                                 Lanes<double>* below) {
    solve_both(factor, x, below);
}
#endif

}  // namespace

void solve_supernodal(const SupernodalFactor& factor, const double* b, double* x, Index columns,
                      std::vector<double>& scratch) {
    const std::size_t n = at(factor.size), rows = at(factor.rows);
    scratch.resize(2 * kSolveWidth * n);
    double* solution = scratch.data();
    for (std::size_t i = 0; i < n; ++i) {
        const Index from = factor.permutation[i];
        for (Index c = 0; c < kSolveWidth; ++c) {
            const bool known = c < columns && from != kNoIndex;
            solution[i * kSolveWidth + c] = known ? b[at(c) * rows + at(from)] : 0.0;
        }
    }
    auto* lanes = reinterpret_cast<Lanes<double>*>(solution);
#ifdef LISSOM_HAS_AVX2_PATH
    if (has_avx2()) {
        solve_with_avx2(factor, lanes, lanes + n);
    } else {
        solve_anywhere(factor, lanes, lanes + n);
    }
#else
    solve_anywhere(factor, lanes, lanes + n);
#endif
    for (std::size_t i = 0; i < n; ++i) {
        const Index to = factor.permutation[i];
        if (to == kNoIndex) continue;
        for (Index c = 0; c < columns; ++c) {
            x[at(c) * rows + at(to)] = solution[i * kSolveWidth + c];
        }
    }
}

}  // namespace lissom
