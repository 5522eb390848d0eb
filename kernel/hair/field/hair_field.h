/// HairField: which way hair grows at every point of the volume around a head.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/field/distance_grid.h"
#include "kernel/hair/field/field_gravity.h"
#include "kernel/hair/field/grid_layout.h"
#include "kernel/solve/field/grid_field.h"
#include "kernel/solve/grid/grid_constraints.h"
#include "kernel/solve/grid/grid_field_options.h"

namespace lissom {

/// The field that the constraints of style curves determine (sections 4.3 and 4.4), with the signed
/// distance to the head beside it.
class HairField {
  public:
    /// Errors: as GridField::GridField.
    HairField(DistanceGrid distances, const GridFieldOptions& options = default_options(),
              const Context& context = {});
    /// With distances of its own to keep hair out of the head (thin_parts.h), one a grid point.
    HairField(DistanceGrid distances, std::span<const float> collision,
              const GridFieldOptions& options = default_options(), const Context& context = {});

    /// Zero-flux boundary and a tension of 0.03, against overshoot far from the curves.
    static GridFieldOptions default_options();

    const DistanceGrid& distances() const { return distances_; }
    const GridLayout& layout() const { return distances_.layout(); }

    /// Replaces the constraints of one curve; none removes it. Takes effect with the next solve.
    /// Errors: as GridField::set_constraints.
    void set_constraints(ConstraintOwner owner, std::vector<GridConstraint> constraints);
    /// Removes the constraints of all curves. Takes effect with the next solve.
    void clear_constraints();
    /// Solves, and blends the directions with those of falling hair. After an error `values` are
    /// those of the last solve. Errors: as GridField::solve.
    void solve(const Context& context = {}, const FieldGravity& gravity = {});
    /// Returns whether `values` are those of the constraints as they are.
    bool solved() const { return !stale_ && field_.solved(); }
    const GridField& grid() const { return field_; }

    /// For each grid point, x fastest: the vector of the last solve, and the signed distance that
    /// keeps hair out of the head.
    std::span<const float> values() const { return values_; }
    /// Puts back values that were read earlier, until the next solve.
    void put_back(std::vector<float> values);

    /// For each grid point the gradient of that distance, by differences between neighbours, and 0
    /// as a fourth number.
    std::span<const float> gradients() const { return gradients_; }

    struct Sample {
        Vec3 direction = Vec3::Zero();
        /// Signed distance to the head as the grid has it, negative inside, and its derivative.
        double distance = 0.0;
        Vec3 gradient = Vec3::Zero();
    };
    /// Trilinear between grid points, at a point of the grid's box; elsewhere at its nearest point.
    Sample sample(const Vec3& point) const;
    bool contains(const Vec3& point) const;

  private:
    DistanceGrid distances_;
    GridField field_;
    // Values are computed beside the shown ones.
    std::vector<float> values_, next_, gradients_;
    bool stale_ = false;
    MemoryCharge charge_;
};

}  // namespace lissom
