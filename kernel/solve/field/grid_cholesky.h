/// GridCholesky: the system of a grid field factored as a whole, as the thesis does it; private to
/// kernel/solve.
#pragma once

#include <memory>

#include "kernel/core/context.h"
#include "kernel/solve/grid/constraint_rows.h"
#include "kernel/solve/grid/grid_field_options.h"
#include "kernel/solve/grid/grid_laplacian.h"

namespace lissom {

/// The sparse Cholesky factor of A0 + U W^2 U', equation (4.3). For use by one thread at a time.
class GridCholesky {
  public:
    GridCholesky() = default;
    virtual ~GridCholesky() = default;
    GridCholesky(const GridCholesky&) = delete;
    GridCholesky& operator=(const GridCholesky&) = delete;

    /// Brings the factor to these constraints, at least one. After an error the
    /// next update factors from nothing. Errors: not_positive_definite; memory_limit; cancelled,
    /// between the stages.
    virtual void update(const ConstraintRows& rows, const Context& context) = 0;
    /// Solves for three fields `b`, component by component, with `refinements` further solves for
    /// the residual; x is not b.
    virtual void solve(const double* b, double* x, int refinements,
                       const Context& context) const = 0;

    virtual const GridCholeskyStats& stats() const = 0;
};

/// Makes a factor: by CHOLMOD in a program that takes in kernel/cholmod. Without it every change of
/// points or weights factors again, by SparseSystem.
std::unique_ptr<GridCholesky> make_grid_cholesky(const GridLaplacian& laplacian);

/// Makes a factor that changes with the constraints by the updates and downdates of section 4.4.2,
/// or null. The library kernel/cholmod has another definition, which takes the place of this one in
/// programs that link it.
std::unique_ptr<GridCholesky> make_updated_cholesky(const GridLaplacian& laplacian);

}  // namespace lissom
