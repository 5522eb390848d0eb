/// As-rigid-as-possible maps; private to kernel/mesh.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/mesh/parameterize/chart.h"
#include "kernel/mesh/parameterize/triangle_shape.h"

namespace lissom {

struct RigidMap {
    /// The last iteration in which no triangle of the faces is turned over; the start if there is
    /// none.
    std::vector<Vec2> uv;
    /// The number of that iteration, from 1; 0 for the start.
    Index iterations = 0;
    /// Same as Parameterization::energy.
    std::vector<double> energy;

    double reached() const { return energy[at(iterations)]; }
    bool ends_with_flips() const { return at(iterations) + 1 < energy.size(); }
};

/// Whether an iteration goes all its way, and may turn triangles over and back again; or, once a
/// map has no flips, no farther than short of the first. The energy never increases in either.
enum class RigidSteps { whole, short_of_flips };

/// Alternates rotations of the triangles, in closed form, and positions, by one factor (Liu et al.
/// 2008, section 4), from a map that has about the scale of the surface.
/// Errors: not_positive_definite; memory_limit; cancelled.
RigidMap rigid_map(const Chart& chart, const std::vector<TriangleShape>& shapes,
                   std::vector<Vec2> start, RigidSteps steps, Index maximum_iterations,
                   const Context& context);

}  // namespace lissom
