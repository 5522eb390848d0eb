#include "kernel/hair/scalp/surface_distance.h"

#include <cmath>

#include "kernel/hair/field/closed_surface.h"

namespace lissom {
namespace {

// In steps: farther away the grid is right about the side, and about the distance to a part of it.
constexpr double kFarFromSurface = 2.0;
// A foot with a smaller weight lies on an edge.
constexpr double kOnEdge = 1e-9;

}  // namespace

SurfaceDistance::SurfaceDistance(const Scalp& scalp, const DistanceGrid& grid, const Mesh& head)
    : scalp_(scalp), grid_(grid), outward_(close_surface(head).volume < 0.0 ? -1.0 : 1.0) {}

double SurfaceDistance::operator()(const Vec3& point) const {
    const double about = grid_.value(point);
    if (!(std::abs(about) < kFarFromSurface * grid_.layout().step)) return about;
    const Vec3 place = scalp_.from_metres(point);
    const SurfacePoint foot = scalp_.tree().nearest(place);
    const Vec3 normal = foot.barycentric.minCoeff() > kOnEdge
                            ? foot.normal
                            : scalp_.normal_at(foot.triangle, foot.barycentric);
    const double side = outward_ * normal.dot(place - foot.position);
    return std::copysign(foot.distance / scalp_.scale(), side);
}

}  // namespace lissom
