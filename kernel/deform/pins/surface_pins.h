/// Pins that let go: vertices held on a plane, on a line or at a distance from a point, and free
/// along it.
#pragma once

#include <span>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/deformer.h"

namespace lissom {

/// The places that a pin allows.
enum class PinPlace { plane, line, sphere };

/// A vertex that slides on a plane, a line or a sphere.
struct SlidingPin {
    Index vertex = kNoIndex;
    PinPlace on = PinPlace::plane;
    /// A point of the plane or line, or the centre of the sphere.
    Vec3 point = Vec3::Zero();
    /// Normal of the plane or direction of the line, of any length.
    Vec3 direction = Vec3::UnitY();
    /// Distance from the centre.
    double radius = 0.0;
};

/// Solves in full as Deformer::solve, with pinned vertices on their places: the forces that hold
/// them there are square to the place, and the surface answers them by the kept factor, with
/// rotations fitted to it again. Handles and constraints hold exactly. Without pins, and if all lie
/// on their places by themselves, the result is that of solve, to the bit. Returns the greatest
/// distance that is left between a vertex and its place: places that contradict each other, such as
/// far ones of neighbours, stay apart. Errors: as Deformer::solve; out_of_range;
/// handle_outside_region; handle_overlap for a vertex that a handle or constraint holds, naming it,
/// or that is pinned twice; invalid_argument for directions without length, a radius that is not
/// above 0, and more than 512 pins; not_finite; unsupported for a comparison method.
double solve_with_pins(Deformer& deformer, std::span<const SlidingPin> pins,
                       const Context& context = own_context());

}  // namespace lissom
