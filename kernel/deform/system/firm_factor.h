/// Factoring of matrices that triangles of very different sizes leave only just positive definite;
/// private to kernel/deform.
#pragma once

#include "kernel/core/context.h"
#include "kernel/solve/sparse/sparse_matrix.h"
#include "kernel/solve/sparse/sparse_system.h"

namespace lissom {

/// Analyses and factors `matrix`, which the constraints are known to determine. If
/// rounding hides that, the diagonal is enlarged by up to a millionth: the unknowns, which are
/// deviations from a similarity, then become a little smaller. `matrix` is the one factored.
/// Errors: not_positive_definite if that does not help; memory_limit; cancelled.
void factor_firmly(SparseSystem& system, SymmetricMatrix& matrix, const Context& context);

}  // namespace lissom
