/// Factoring of matrices that triangles of very different sizes leave only just positive definite;
/// private to kernel/deform.
#pragma once

#include <functional>

#include "kernel/core/context.h"
#include "kernel/solve/sparse/sparse_matrix.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {

/// Factors `matrix`, which the constraints are known to determine, by calling factor(). If
/// rounding hides that, the diagonal is enlarged by up to a millionth: the unknowns, which are
/// deviations from a similarity, then become a little smaller. `matrix` is the one factored.
/// Returns true if it was. Errors: not_positive_definite if that does not help; those of `factor`.
bool factor_firmly(SymmetricMatrix& matrix, const std::function<void()>& factor);

/// Analyses and factors `matrix` so. Errors: also memory_limit; cancelled.
void factor_firmly(SparseSystem& system, SymmetricMatrix& matrix, const Context& context);

}  // namespace lissom
