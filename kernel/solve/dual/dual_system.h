/// DualSystem: the constraint multipliers of a grid field; private to kernel/solve.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/solve/dual/bordered_cholesky.h"
#include "kernel/solve/dual/projected_cg.h"
#include "kernel/solve/grid/constraint_rows.h"
#include "kernel/solve/grid/field_workspace.h"
#include "kernel/solve/grid/grid_green.h"

namespace lissom {

/// The system
///     (G + W^-2) lambda + 1 a = g,   1' lambda = total
/// for three right-hand sides, with G holding the entries of A0+ at the constrained points and W
/// their weights. With total = 0 and g the known vectors, A0+ U lambda + a is the field that
/// minimises (4.1) with the soft constraints of (4.2). Up to `dense_limit` rows it is solved with a
/// dense factor of M = G + W^-2 + shift 1 1'; an edit renews its rows from the first
/// changed one on; beyond, by conjugate gradients.
class DualSystem {
  public:
    DualSystem(const GridGreen& green, Index dense_limit, double tolerance);

    const ConstraintRows& rows() const { return rows_; }
    /// Returns whether the rows of the last update are too many for the dense factor.
    bool iterates() const { return iterative_ != nullptr; }
    /// Bytes for `rows` rows.
    static std::size_t bytes(std::size_t rows, Index dense_limit);

    /// Changes the rows. After an error only rows that both have in common at the front are left.
    /// Errors: not_positive_definite, memory_limit, cancelled.
    void update(const ConstraintRows& rows, const Context& context);
    /// Solves for the rows of the last update.
    DualSolution solve(std::span<const Vec3> g, const Vec3& total, FieldWorkspace& workspace,
                       const Context& context) const;

  private:
    void update_dense(const ConstraintRows& rows, const Context& context);
    DualSolution solve_dense(std::span<const Vec3> g, const Vec3& total) const;

    const GridGreen& green_;
    Index dense_limit_;
    double tolerance_;
    ConstraintRows rows_;
    BorderedCholesky factor_;
    std::unique_ptr<ProjectedCG> iterative_;
};

}  // namespace lissom
