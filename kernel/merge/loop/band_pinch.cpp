#include "kernel/merge/loop/band_pinch.h"

#include <algorithm>
#include <cmath>

#include "kernel/merge/loop/face_angles.h"

namespace lissom {
namespace {

// Change of a slope that shows, and a slope that does not.
constexpr double kPinched = 30.0 * kDegree, kFlatSlope = 10.0 * kDegree;

// Height of a vertex over its neighbours as an angle, above 0 for one that stands out, and the mean
// distance of these from its axis.
struct Slope {
    double angle = 0.0, width = 0.0;
};

Vec3 area_around(const Mesh& mesh, std::span<const Vec3> places, Index v) {
    Vec3 sum = Vec3::Zero();
    for (const Index f : mesh.topology().faces_around(v)) {
        const std::span<const Index> face = mesh.topology().face(f);
        const Vec3& first = places[at(face[0])];
        for (std::size_t k = 1; k + 1 < face.size(); ++k) {
            sum += (places[at(face[k])] - first).cross(places[at(face[k + 1])] - first);
        }
    }
    return sum;
}

Slope slope_at(const Mesh& mesh, std::span<const Vec3> places, Index v) {
    const Vec3 area = area_around(mesh, places, v);
    if (!(area.squaredNorm() > 0.0)) return {};
    const Vec3 axis = area.normalized();
    double height = 0.0, width = 0.0, count = 0.0;
    for (const Index n : mesh.topology().neighbors(v)) {
        const Vec3 arm = places[at(v)] - places[at(n)];
        height += arm.dot(axis);
        width += arm.cross(axis).norm();
        count += 1.0;
    }
    return {std::atan2(height, width), width / count};
}

bool has_rest(const PinchPlaces& places, Index v) {
    if (!places.rest[at(v)].allFinite()) return false;
    const auto around = places.mesh.topology().neighbors(v);
    return std::all_of(around.begin(), around.end(),
                       [&](Index n) { return places.rest[at(n)].allFinite(); });
}

// Change of a slope, 0 for one that became flatter to the same side.
double steepened(double now, double before) {
    if (std::abs(now) < kFlatSlope) return 0.0;
    const bool flatter = now * before > 0.0 && std::abs(now) < std::abs(before);
    return flatter ? 0.0 : std::abs(now - before);
}

}  // namespace

std::vector<Pinch> pinches(const PinchPlaces& places) {
    std::vector<Pinch> result;
    const Topology& topology = places.mesh.topology();
    for (Index v = 0; v < places.mesh.vertex_count(); ++v) {
        if (!(places.distance[at(v)] <= places.reach) || topology.is_boundary(v)) continue;
        if (!has_rest(places, v)) continue;
        const Slope now = slope_at(places.mesh, places.mesh.positions(), v);
        const Slope before = slope_at(places.mesh, places.rest, v);
        if (steepened(now.angle, before.angle) > kPinched) result.push_back({v, now.width});
    }
    return result;
}

}  // namespace lissom
