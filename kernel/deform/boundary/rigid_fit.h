/// The local step of ARAP iterations on the second system: the rotations that fit positions best
/// (Sorkine and Alexa, "As-rigid-as-possible surface modeling", 2007); private to kernel/deform.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/boundary/boundary_deformer.h"
#include "kernel/deform/system/frame_loops.h"

namespace lissom {

/// Limit of a vertex's rotation: none at all unless it is free, else the slack of its value, if
/// any.
struct TurnLimit {
    bool free = true;
    const BoundaryValue* value = nullptr;
};

/// The transforms of vertices, sizes times rotations, and their energy: that of the second system,
/// but with each edge counted for the transforms of both ends by themselves, one half each. At the
/// same transforms both have their least at the same positions.
struct FittedTurns {
    std::vector<Mat3> transform;
    double energy = 0.0;
};

/// Returns the transforms of least energy at positions x, with the sizes of `now` and the
/// transforms of `now` at vertices that do not turn.
FittedTurns fitted_turns(const EnergyLoop& loop, std::span<const Vec4> x, std::span<const Mat3> now,
                         std::span<const double> size, std::span<const TurnLimit> limits,
                         const Context& context);

/// The way from each transform to another of its size, and `further` times that beyond it, as far
/// as the limits allow.
std::vector<Mat3> turned_beyond(std::span<const Mat3> from, std::span<const Mat3> to,
                                std::span<const double> size, std::span<const TurnLimit> limits,
                                double further);

}  // namespace lissom
