/// A shape in single precision about its own middle; private to kernel/deform.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"

namespace lissom {

/// Three coordinates, and 0 as the fourth.
using LocalPoint = Eigen::Array4f;

/// Positions relative to the middle of their bounding box, in single precision.
struct LocalShape {
    std::vector<LocalPoint> points;
    /// The greatest coordinate. Points are rounded by less than 1e-7 of it.
    float extent = 0.0F;

    /// Takes the points of `shape`. Errors: not_finite beyond 1e30 of its middle; cancelled.
    void set(std::span<const Vec3> shape, const Context& context);
};

}  // namespace lissom
