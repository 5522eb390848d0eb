/// Triangular solves with a supernodal Cholesky factor for few right-hand sides; private to
/// kernel/solve. With three columns, dense libraries spend their time packing; here four columns
/// stay in registers.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/solve/sparse/supernodal_loops.h"

namespace lissom {

/// A supernodal factor of `size` rows for solutions of `rows` unknowns: the supernodes that take
/// part, ascending, and the unknown of each row of L, or kNoIndex for those that take none.
struct SupernodalFactor {
    Index size = 0, rows = 0;
    std::span<const Index> supernodes;
    SupernodalView<double> view;
    const Index* permutation = nullptr;
};

/// Columns that one pass solves for.
inline constexpr Index kSolveWidth = 4;

/// Solves L L^T x = b for up to `kSolveWidth` columns, stored one after the other; x may be b.
/// `scratch` is sized as needed and may be kept for the next call.
void solve_supernodal(const SupernodalFactor& factor, const double* b, double* x, Index columns,
                      std::vector<double>& scratch);

}  // namespace lissom
