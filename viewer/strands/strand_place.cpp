#include "viewer/strands/strand_place.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lissom {
namespace {

// Roots that are looked at; they lie all over the scalp.
constexpr std::size_t kLookedAt = 2000;
// Ratio of the distances that may remain between both: else they are of another mesh.
constexpr double kTolerance = 0.02;

double spread(const std::vector<Vec3>& points) {
    Vec3 center = Vec3::Zero();
    for (const Vec3& p : points) center += p;
    center /= static_cast<double>(points.size());
    double sum = 0.0;
    for (const Vec3& p : points) sum += (p - center).squaredNorm();
    return std::sqrt(sum);
}

std::optional<Vec3> place_on(const Mesh& mesh, Index face, const Eigen::Vector3f& barycentric) {
    if (face < 0 || face >= mesh.face_count() || mesh.topology().face(face).size() < 3) {
        return std::nullopt;
    }
    const auto corners = mesh.topology().face(face);
    Vec3 place = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
        place += static_cast<double>(barycentric[i]) *
                 mesh.position(corners[static_cast<std::size_t>(i)]);
    }
    return place;
}

}  // namespace

std::optional<double> unit_of_roots(const Strands& strands, const Mesh& mesh) {
    const StrandRoots& roots = strands.roots();
    std::vector<Vec3> places, points;
    const std::size_t stride = std::max(roots.faces.size() / kLookedAt, std::size_t{1});
    for (std::size_t s = 0; s < roots.faces.size(); s += stride) {
        const auto place = place_on(mesh, roots.faces[s], roots.barycentrics[s]);
        const Vec3 point = strands.root(static_cast<Index>(s)).cast<double>();
        if (!place) return std::nullopt;
        if (!point.allFinite()) continue;
        places.push_back(*place);
        points.push_back(point);
    }
    if (places.size() < 2) return std::nullopt;
    const double unit = spread(points) / spread(places);
    if (!std::isfinite(unit) || unit <= 0.0) return std::nullopt;
    for (Vec3& place : places) place *= unit;
    double off = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        off = std::max(off, (places[i] - points[i]).norm());
    }
    return off < kTolerance * spread(points) ? std::optional(unit) : std::nullopt;
}

}  // namespace lissom
