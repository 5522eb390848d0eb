/// Triangular solves with a supernodal Cholesky factor for few right-hand sides; private to
/// kernel/solve. With three columns, dense libraries spend their time packing; here four columns
/// stay in registers.
#pragma once

#include <vector>

#include "kernel/core/geometry.h"

namespace lissom {

/// A supernodal factor L as CHOLMOD lays it out. Supernode s holds the columns super[s] .. super[s
/// + 1] - 1 as one dense column-major block at value[first_value[s]]; its rows are
/// row[first_row[s]] .. row[first_row[s + 1] - 1], of which the first are those columns themselves.
struct SupernodalFactor {
    Index size = 0, supernodes = 0;
    const Index* super = nullptr;
    const Index* first_row = nullptr;
    const Index* first_value = nullptr;
    const Index* row = nullptr;
    const double* value = nullptr;
    /// Unknown of each row of L.
    const Index* permutation = nullptr;
};

/// Columns that one pass solves for.
inline constexpr Index kSolveWidth = 4;

/// Solves L L^T x = b for up to `kSolveWidth` columns, stored one after the other; x may be b.
/// `scratch` is sized as needed and may be kept for the next call.
void solve_supernodal(const SupernodalFactor& factor, const double* b, double* x, Index columns,
                      std::vector<double>& scratch);

}  // namespace lissom
