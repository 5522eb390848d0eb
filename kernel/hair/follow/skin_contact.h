/// Contact of moved hair with the skin; private to kernel/hair.
#pragma once

#include <optional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/hair/follow/head_motion.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Height of a point over the skin below it, and the unit normal there.
struct SkinHeight {
    double height = 0.0;
    Vec3 normal = Vec3::Zero();
};

/// Heights over a head of triangles in one shape, negative inside, by its nearest places.
class SkinSurface {
  public:
    /// `sign` is -1 for faces that look inward.
    SkinSurface(std::vector<Vec3> places, const Triangulation& triangles, const Topology& topology,
                double sign, const Context& context);

    /// Returns the height if the skin is within `reach`; nothing beyond an open edge of it.
    std::optional<SkinHeight> height(const Vec3& point, double reach) const;
    /// Returns the nearest place within `reach`.
    std::optional<SurfacePoint> nearest(const Vec3& point, double reach) const;

  private:
    bool is_open(const SurfacePoint& foot) const;

    const Topology& topology_;
    std::vector<Vec3> normals_;
    double sign_;
    SpatialTree tree_;
};

}  // namespace lissom
