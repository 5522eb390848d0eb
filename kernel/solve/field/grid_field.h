/// GridField: vectors on a uniform grid, as smooth as given vectors at some of its points allow.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/solve/grid/grid_constraints.h"
#include "kernel/solve/grid/grid_field_options.h"
#include "kernel/solve/grid/grid_size.h"

namespace lissom {

/// The field t that minimises the energy (4.1) of the thesis subject to the soft constraints of
/// (4.2):
///     sum over the points of |D t|^2  +  sum over the constraints of w^2 |t_i - c_i|^2,
/// three components at every point of a grid. Constraints belong to owners; replacing those of one
/// owner and solving costs as much as the change, least of all if the same owner was edited last.
/// The field follows, to the bit, from the constraints and from the order in which owners last
/// changed their points or weights, for any history; with the cholesky solver, up to rounding.
/// Without any constraint the field is zero; one constraint alone, or several equal ones, give a
/// constant field. For use by one thread at a time; it works on the threads of the context given,
/// and results do not depend on their number.
class GridField {
  public:
    /// Errors: invalid_argument for a size that require_valid refuses or options out of range;
    /// memory_limit.
    explicit GridField(const GridSize& size, const GridFieldOptions& options = {},
                       const Context& context = {});
    ~GridField();
    GridField(GridField&&) noexcept;
    GridField& operator=(GridField&&) noexcept;

    /// Returns the bytes that a field takes with this many constraints, including most of a solve;
    /// for the cholesky solver, those known before its analysis.
    static std::size_t predicted_bytes(const GridSize& size, std::size_t constraints,
                                       const GridFieldOptions& options = {});

    const GridSize& size() const;
    const GridFieldOptions& options() const;

    /// Replaces all constraints of `owner`; none removes it. Takes effect with the next solve.
    /// Errors: as GridConstraints::set; then nothing was changed.
    void set_constraints(ConstraintOwner owner, std::vector<GridConstraint> constraints);
    const GridConstraints& constraints() const;
    /// Removes the constraints of all owners.
    void clear();

    /// Computes the field of the constraints as they are; does nothing if none has changed. After
    /// an error the field is that of the last solve. Errors: not_positive_definite if weights
    /// differ too much for double precision; memory_limit; cancelled.
    void solve(const Context& context = {});
    /// Returns whether the field is that of the constraints as they are.
    bool solved() const;

    /// Writes the field of the last solve, one vector a point, in the order of GridSize::index.
    /// Errors: invalid_argument if the size differs; cancelled, and then the values are undefined.
    void evaluate(std::span<Vec3> vectors, const Context& context = {}) const;
    /// Writes four floats a point: x, y, z and one left unchanged.
    void evaluate(std::span<float> quads, const Context& context = {}) const;

    /// Constrained points of the last solve.
    Index constraint_count() const;
    /// Returns the counts of the cholesky solver; zeros with the dual one.
    GridCholeskyStats cholesky_stats() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace lissom
