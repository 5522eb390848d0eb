/// The skull above the ears of a head: ears stand out of it.
#pragma once

#include <array>

#include "kernel/core/geometry.h"
#include "kernel/hair/scalp/head_frame.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {

/// Radius of the skull above the ears, in ellipses of the head's slice: many skulls are wider there
/// than the ellipse, and ears stand out of both.
class SkullOverEars {
  public:
    /// Azimuths between which ears lie.
    static constexpr double kFront = 78.0 * kDegree, kBack = 122.0 * kDegree;

    /// An ellipse.
    SkullOverEars() { radii_.fill({1.0, 1.0}); }
    /// Takes the exits of rays just above the ears.
    SkullOverEars(const SpatialTree& head, const HeadFrame& frame);

    /// Returns the radius in the direction of a point of the frame, at least 1; linear between the
    /// rays.
    double radius_at(const Vec3& point) const;
    /// Returns the radius of a point of the frame across the axis of the head, in ellipses.
    static double ellipses(const HeadFrame& frame, const Vec3& point);

  private:
    static constexpr int kRays = 25;
    // Right and left of the head.
    std::array<std::array<double, 2>, kRays> radii_;
};

}  // namespace lissom
