/// ProjectedCG: conjugate gradients for the multipliers of many constraints; private to
/// kernel/solve.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/solve/dual/maximin_factor.h"
#include "kernel/solve/grid/constraint_rows.h"
#include "kernel/solve/grid/field_workspace.h"
#include "kernel/solve/grid/grid_green.h"

namespace lissom {

/// Multipliers lambda, one a row, and the constant a.
struct DualSolution {
    std::vector<Vec3> multiplier;
    Vec3 constant = Vec3::Zero();
};

/// Solves the system of DualSystem without its matrix: a product is a cosine transform there and
/// back. Iterates keep their sum; the preconditioner, a MaximinFactor, is projected to do so.
class ProjectedCG {
  public:
    /// Iterations end when the residual is below `tolerance` times the greatest right-hand side.
    ProjectedCG(const GridGreen& green, double tolerance) : green_(green), tolerance_(tolerance) {}

    /// Errors: cancelled, memory_limit; then it is as before.
    void update(const ConstraintRows& rows, const Context& context);
    /// Solves as DualSystem::solve does. Errors: not_positive_definite if it does not converge;
    /// cancelled.
    DualSolution solve(std::span<const Vec3> g, const Vec3& total, FieldWorkspace& workspace,
                       const Context& context) const;

  private:
    void multiply(const std::vector<Vec3>& x, std::vector<Vec3>& y, FieldWorkspace& workspace,
                  const Context& context) const;

    const GridGreen& green_;
    double tolerance_;
    ConstraintRows rows_;
    MaximinFactor factor_;
    /// The preconditioner applied to 1, and the sum of that.
    std::vector<Vec3> ones_;
    double ones_sum_ = 0.0;
};

}  // namespace lissom
