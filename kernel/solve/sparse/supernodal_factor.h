/// Numeric supernodal Cholesky factorisation; private to kernel/solve.
#pragma once

#include <cstddef>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/solve/sparse/dense_kernels.h"
#include "kernel/solve/sparse/factor_plan.h"
#include "kernel/solve/sparse/supernodes.h"

namespace lissom {

/// Bytes that `factor_supernodes` takes besides the factor, for as long as it runs.
std::size_t factoring_bytes(const Supernodes& nodes, const FactorPlan& plan);

/// Input and output of a factorisation. `matrix` are the values of a matrix of the pattern of
/// `nodes` and `plan`; `value` takes nodes.value_count() values, with zeros above diagonals.
struct FactorTask {
    const Supernodes& nodes;
    const FactorPlan& plan;
    const double* matrix;
    double* value;
    /// If given, only supernodes with an entry other than 0 are computed; values and extensions of
    /// the others are those of the task before. Every supernode above one of them has to be one.
    const char* changed = nullptr;
    /// If given, supernodes with an entry other than 0 have columns of the identity alone; their
    /// values are not written.
    const char* idle = nullptr;
    /// plan.extension_bytes() bytes that are kept for the next task, or null.
    double* extensions = nullptr;
};

/// Factors a matrix. Subtrees run in parallel, then the panels of each supernode above them; the
/// result is the same for any number of threads. Returns kNoIndex, or the first column with a
/// pivot that is not positive. Errors: cancelled, between supernodes and panels.
Index factor_supernodes(const FactorTask& task, Processor processor, const Context& context);

}  // namespace lissom
