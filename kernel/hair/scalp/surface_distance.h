/// SurfaceDistance: signed distance to a head itself. A DistanceGrid interpolates between grid
/// points, which are farther apart than ears and noses are thick.
#pragma once

#include "kernel/core/geometry.h"
#include "kernel/hair/field/distance_grid.h"
#include "kernel/hair/scalp/scalp.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

class SurfaceDistance {
  public:
    /// `grid` is that of the head of `scalp` in metres of its frame; both must live longer.
    SurfaceDistance(const Scalp& scalp, const DistanceGrid& grid, const Mesh& head);

    /// Metres of the frame, negative inside; that of the grid at points more than two steps away.
    /// Thread-safe.
    double operator()(const Vec3& point) const;

  private:
    const Scalp& scalp_;
    const DistanceGrid& grid_;
    /// -1 if the faces of the head look inward.
    double outward_ = 1.0;
};

}  // namespace lissom
