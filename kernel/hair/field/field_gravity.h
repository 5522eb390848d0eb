/// Gravity: hair falls if no style curve is near.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/field/grid_layout.h"

namespace lissom {

/// In metres of the scalp's frame, as the grid: x to the head's left, y up, z to the front.
struct FieldGravity {
    /// Share of the fallen direction at points far from all curves, 0 to 1; 0 for none.
    double amount = 0.0;
    /// Grid points that style curves constrain. Within `held` of one, or 1.5 steps of a coarse
    /// grid, the field is that of the curves; over the length `fade` from there gravity takes over.
    std::vector<Index> styled = {};
    double held = 0.015, fade = 0.045;
    /// Centers of ties: hair near the head goes to the nearest one instead of falling.
    std::vector<Vec3> ties = {};
};

/// Blends the directions of a field with those of falling hair. `values` are those of
/// HairField::values, `gradients` those of HairField::gradients. Over the head, hair falls along
/// it, a little to the back; over the face it goes to the sides, from a line in the middle. Not in
/// the thesis.
void add_gravity(std::span<float> values, std::span<const float> gradients,
                 const GridLayout& layout, const FieldGravity& gravity,
                 const Context& context = {});

/// Returns the direction of hair that no curve styles, of unit length, at `distance` metres from
/// the head along `outward`, the gradient of the distance.
Vec3 fallen_direction(const Vec3& point, double distance, const Vec3& outward,
                      std::span<const Vec3> ties = {});

}  // namespace lissom
