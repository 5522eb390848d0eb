/// Strokes that take their depth from a cloud of points, as strands of hair are.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/sketch/view.h"

namespace lissom {

struct CloudStrokeOptions {
    /// Pixels around each point of the stroke in which the cloud is seen.
    double radius = 12.0;
    /// The share of the points there that may stand out in front.
    double before = 0.1;
};

/// Returns the stroke at the front of the cloud: in front of all but a few of the points that are
/// seen within `radius`. If there are none, depth changes evenly between the places that have some,
/// and stays beyond the first and last of them. `cloud` has three coordinates a point. Errors:
/// not_finite; invalid_argument if none of the cloud is seen under the stroke, or for options out
/// of range; cancelled.
std::vector<Vec3> stroke_before_cloud(std::span<const Vec2> stroke, const View& view,
                                      std::span<const float> cloud,
                                      const CloudStrokeOptions& options = {},
                                      const Context& context = {});

}  // namespace lissom
