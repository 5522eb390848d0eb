/// GridCholesky: the system of a grid field factored as a whole, as the thesis does it; private to
/// kernel/solve.
#pragma once

#include <memory>

#include "kernel/core/context.h"
#include "kernel/solve/grid/constraint_rows.h"
#include "kernel/solve/grid/grid_field_options.h"
#include "kernel/solve/grid/grid_laplacian.h"

namespace lissom {

/// The sparse Cholesky factor of A0 + U W^2 U', equation (4.3), changed with the constraints by the
/// updates and downdates of section 4.4.2; if very many change, it is computed anew because that is
/// cheaper. The ordering is nested dissection of the grid. CHOLMOD factors in supernodes, which are
/// then converted to the L D L' that it can change. In a build without GPL, every change of points
/// or weights factors again, by SparseSystem. For use by one thread at a time.
class GridCholesky {
  public:
    explicit GridCholesky(const GridLaplacian& laplacian);
    ~GridCholesky();

    /// Brings the factor to these constraints, of which there is at least one. After an error the
    /// next update factors from nothing. Errors: not_positive_definite; memory_limit; cancelled,
    /// between the stages.
    void update(const ConstraintRows& rows, const Context& context);
    /// Solves for three fields `b`, component by component, with `refinements` further solves for
    /// the residual; x is not b.
    void solve(const double* b, double* x, int refinements, const Context& context) const;

    const GridCholeskyStats& stats() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lissom
