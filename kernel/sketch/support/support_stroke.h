/// Strokes that take their depth from a curve: on its supporting surface, or as deep as the curve
/// itself.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/sketch/support/support_surface.h"
#include "kernel/sketch/view.h"

namespace lissom {

/// Lengths in the world.
struct SupportStrokeOptions {
    /// Beside the surface depth continues with its slope over the last `run` of the stroke, at most
    /// 1, and turns to a constant over about `fade`.
    double run = 0.008, fade = 0.04;
};

struct SupportStroke {
    /// Points, one for each of the stroke.
    std::vector<Vec3> points;
    /// Number of points beside the surface.
    std::size_t beside = 0;
};

/// Returns the stroke on a supporting surface. If the line of sight meets it several times, the
/// stroke continues at its present place along the curve; it begins at the place that is nearest to
/// the curve. Between two parts over the surface depth changes evenly. Errors: not_finite;
/// invalid_argument if the surface is seen edge-on, less squarely than 0.3, or the stroke is
/// nowhere over it.
SupportStroke stroke_on_support(std::span<const Vec2> stroke, const View& view,
                                const SupportSurface& support,
                                const SupportStrokeOptions& options = {});

/// Returns the stroke at the depth of the curve's place that is seen nearest to each point. Errors:
/// not_finite; invalid_argument for a curve of less than two points that differ, or one that is not
/// wholly in front of the camera.
std::vector<Vec3> stroke_beside_curve(std::span<const Vec2> stroke, const View& view,
                                      std::span<const Vec3> curve);

}  // namespace lissom
