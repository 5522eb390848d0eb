/// Numeric supernodal Cholesky factorisation; private to kernel/solve.
#pragma once

#include <cstddef>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/solve/sparse/dense_kernels.h"
#include "kernel/solve/sparse/factor_plan.h"
#include "kernel/solve/sparse/sparse_matrix.h"
#include "kernel/solve/sparse/supernodes.h"

namespace lissom {

/// Bytes that `factor_supernodes` takes besides the factor, for as long as it runs.
std::size_t factoring_bytes(const Supernodes& nodes, const FactorPlan& plan);

/// Factors `matrix`, which has the pattern of `nodes` and `plan`, into nodes.value_count() values
/// at `value`. The old values do not matter; zeros are written above diagonals. Subtrees run in
/// parallel, then the panels of each supernode above them; the result is the same for any number of
/// threads. Returns kNoIndex, or the first column with a pivot that is not positive. Errors:
/// cancelled, between supernodes and panels.
Index factor_supernodes(const Supernodes& nodes, const FactorPlan& plan,
                        const SymmetricMatrix& matrix, double* value, Processor processor,
                        const Context& context);

}  // namespace lissom
