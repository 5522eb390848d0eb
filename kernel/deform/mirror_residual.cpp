#include "kernel/deform/mirror_residual.h"

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "kernel/deform/holds/mirror.h"
#include "kernel/deform/holds/mirror_surface.h"

namespace lissom {
namespace {

// In radii of the surface: faces of people differ by about one percent.
constexpr double kUsualResidual = 0.02;

std::string warning_of(double greatest, double tolerance) {
    if (greatest <= tolerance) return {};
    char text[240];
    std::snprintf(
        text, sizeof text,
        "the mirror image lies up to %.1f %% of the size from the surface (limit %.2g %%); "
        "let the plane go through the middle of the shape, or give each side a handle",
        100.0 * greatest, 100.0 * tolerance);
    return text;
}

}  // namespace

MirrorResidual residual_of(const RestShape& rest, const Handle& handle) {
    const MirrorPlane& plane = handle.mirror;
    const MirrorSurface surface(rest.patch(),
                                reflection({plane.point - rest.origin(), plane.normal, 0.0}));
    std::vector<double> distances;
    for (const Index v : handle.local) distances.push_back(surface.foot_of(v).distance);
    for (const SparseRow& row : handle.points) {
        distances.push_back(surface.foot_of(rest.position_of(row)).distance);
    }
    const double radius = rest.work->radius;
    MirrorResidual result;
    for (const double d : distances) {
        result.max = std::max(result.max, d / radius);
        result.mean += d / radius / static_cast<double>(distances.size());
    }
    const double limit = plane.tolerance > 0.0 ? plane.tolerance / radius : kUsualResidual;
    result.warning = warning_of(result.max, limit);
    return result;
}

}  // namespace lissom
