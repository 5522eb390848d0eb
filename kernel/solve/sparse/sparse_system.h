/// SparseSystem: direct solution of symmetric positive definite systems, many times with one
/// pattern.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "kernel/core/context.h"
#include "kernel/core/extended.h"
#include "kernel/core/index.h"
#include "kernel/solve/sparse/single_factor.h"
#include "kernel/solve/sparse/sparse_matrix.h"

namespace lissom {

/// Costs of analysis and factorisation.
struct FactorStats {
    /// Entries of the Cholesky factor, and the bytes it takes with its analysis, known after
    /// `analyze`.
    std::size_t factor_nonzeros = 0, factor_bytes = 0;
    /// The part of factor_bytes that `analyze` has charged.
    std::size_t analysis_bytes = 0;
    /// Supernodes, and those that the last factorisation computed.
    Index supernodes = 0, computed_supernodes = 0;
    /// Further bytes that `factor` takes while it runs.
    std::size_t working_bytes = 0;
    double analyze_seconds = 0, factor_seconds = 0;
};

/// A factored symmetric positive definite matrix. Several threads may solve with it at once; one
/// alone analyses and factors. Supernodal Cholesky, ordered by approximate minimum degree. `factor`
/// runs on the threads of its context, and its result does not depend on their number.
class SparseSystem {
  public:
    SparseSystem();
    ~SparseSystem();
    SparseSystem(SparseSystem&&) noexcept;
    SparseSystem& operator=(SparseSystem&&) noexcept;

    /// Orders the unknowns and predicts the factor. Only the pattern of `matrix` matters. Memory is
    /// charged before it is allocated, and the result is held as long as the analysis. After an
    /// error the analysis before stays. Errors: invalid_argument for an empty matrix; memory_limit,
    /// also for a factor of more than 2^31 - 1 entries; cancelled.
    void analyze(const SymmetricMatrix& matrix, const Context& context = {});
    /// Factors `matrix`, which must have the pattern analysed; memory is charged first and held as
    /// long as the factor. May be called again with new values. After an error there is no factor.
    /// Errors: not_positive_definite, naming one row of a component without a constraint if there
    /// is one; memory_limit; invalid_argument if the pattern differs; cancelled.
    void factor(const SymmetricMatrix& matrix, const Context& context = {});
    /// Factors a matrix over a part of the unknowns analysed: its row i is unknown part[i], which
    /// ascend, and its entries have to be among those analysed. `size` is then that of the part.
    /// Called again, it factors only what depends on columns that have changed, to the same bits as
    /// a system without a factor. Keeps more memory for that than `factor` does. Errors: as
    /// `factor`.
    void factor_part(const SymmetricMatrix& matrix, std::span<const Index> part,
                     const Context& context = {});

    /// Solves A x = b for `columns` right-hand sides stored one after the other; x may be b.
    /// Errors: invalid_argument without a factor or if sizes differ.
    void solve(std::span<const double> b, std::span<double> x, Index columns) const;

    /// Solves as `solve` does, then makes one step of iterative refinement. Right-hand side and
    /// residual are in extended precision if the platform has it, so that ill-conditioned systems
    /// lose nothing to the rounding of b. `matrix` is the one factored. Costs two to three times as
    /// much.
    void solve_refined(const SymmetricMatrix& matrix, std::span<const Extended> b,
                       std::span<double> x, Index columns) const;

    /// Returns a copy of the factor in single precision. Errors: invalid_argument without a factor;
    /// memory_limit.
    SingleFactor single_factor(const Context& context = {}) const;

    /// Number of unknowns of a solve.
    Index size() const;
    bool factored() const;
    const FactorStats& stats() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lissom
