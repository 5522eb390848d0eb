/// Checks of the input and the results of SparseSystem; private to kernel/solve.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/solve/sparse/sparse_matrix.h"

namespace lissom {

/// Returns a fraction: a pivot below this fraction of its diagonal entry is rounding noise of a
/// singular matrix, which grows with the square root of the number of unknowns. The smallest honest
/// ratio seen, for fourth-order systems of a million unknowns, is ten times larger.
double smallest_pivot(Index size);

/// Errors: invalid_argument for an empty matrix or arrays that do not belong together.
void require_valid(const SymmetricMatrix& matrix);
/// Errors: invalid_argument if `matrix` has not the pattern remembered in `begin` and `row`.
void require_pattern(const SymmetricMatrix& matrix, const std::vector<Index>& begin,
                     const std::vector<Index>& row);
/// Errors: invalid_argument if there is no factor.
void require_factor(bool factored);
/// Errors: invalid_argument if the spans do not hold `columns` vectors of length `size`.
void require_sizes(std::span<const double> b, std::span<double> x, Index size, Index columns);
/// Throws not_positive_definite, naming the rows of the connected component of `row`.
[[noreturn]] void refuse_pivot(const SymmetricMatrix& matrix, Index row);

}  // namespace lissom
