/// The thesis's weights at the faces of the grid, from the zero-flux solver; private to
/// kernel/solve.
#pragma once

#include <cstddef>
#include <span>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/solve/dual/dual_system.h"
#include "kernel/solve/grid/field_workspace.h"
#include "kernel/solve/grid/grid_green.h"
#include "kernel/solve/grid/grid_laplacian.h"

namespace lissom {

/// Input of `correct_boundary`.
struct BoundaryProblem {
    /// The operator with the thesis's weights, and the one that is diagonal in the cosine basis.
    const GridLaplacian& exact;
    const GridGreen& green;
    /// Holds the constraints.
    const DualSystem& dual;
    /// Iterations end when they change no component by more than this.
    double tolerance = 0.0;
};

/// Buffers of three fields that `correct_boundary` needs besides the workspace and the result.
inline constexpr std::size_t kCorrectionFields = 4;

/// Turns `field`, the zero-flux solution with these multipliers, into the solution of (A0 + U W^2
/// U') t = U W^2 c with A0 having the thesis's weights. Conjugate gradients, preconditioned by the
/// zero-flux system with the same constraints: the residual lives on the two outer layers of the
/// grid, and some eight iterations reach 1e-7. Errors: not_positive_definite if it does not
/// converge; memory_limit; cancelled.
void correct_boundary(const BoundaryProblem& problem, std::span<const Vec3> multipliers,
                      double* field, FieldWorkspace& workspace, const Context& context);

}  // namespace lissom
