#include "kernel/merge/sheet/sheet_rest.h"

#include <Eigen/Geometry>
#include <utility>

#include "kernel/mesh/mesh.h"

namespace lissom {
namespace {

// How far towards its triangle a corner is read, and weights that do not count.
constexpr double kTowards = 1e-4, kNoWeight = 1e-7;
// Triangles whose height is a smaller part of their length have no normal but that of rounding.
constexpr double kFlatRest = 1e-10;
// Offset of points for queries of the nearest, in edges.
constexpr double kAside = 1e-8;

// Barycentric coordinates of the point of a triangle near `p`, which lies on it or next to it.
Vec3 weights_near(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
    const Vec3 n = (b - a).cross(c - a);
    const double square = n.squaredNorm();
    if (!(square > 0.0)) return {1.0, 0.0, 0.0};
    Vec3 w((b - p).cross(c - p).dot(n), (c - p).cross(a - p).dot(n), (a - p).cross(b - p).dot(n));
    w /= square;
    for (Index k = 0; k < 3; ++k) w[k] = w[k] > kNoWeight ? w[k] : 0.0;
    return w / w.sum();
}

std::vector<ElementMap::Source> weighted_sources(const Triangle& elements, const Vec3& weights) {
    std::vector<ElementMap::Source> sources;
    for (std::size_t k = 0; k < 3; ++k) {
        const double weight = weights[index_of(k)];
        if (weight > 0.0) sources.push_back({elements[k], weight});
    }
    return sources;
}

// None of the triangles knows its neighbours, so that they need be no manifold.
Mesh apart(const std::vector<Vec3>& points) {
    FaceList list;
    for (Index k = 0; k < count_of(points); k += 3) list.add({k, k + 1, k + 2});
    return Mesh(points, std::move(list));
}

Vec3 offset_of(const std::vector<Vec3>& points) {
    for (std::size_t t = 0; t + 2 < points.size(); t += 3) {
        const Vec3 u = points[t + 1] - points[t], w = points[t + 2] - points[t];
        const Vec3 n = u.cross(w);
        if (!(n.norm() > kFlatRest * u.squaredNorm())) continue;
        return kAside * (0.37 * u + 0.61 * w + 0.53 * u.norm() * n.normalized());
    }
    return Vec3::Zero();
}

}  // namespace

void SheetRest::set_points(std::vector<Vec3> points, const Context& context) {
    points_ = std::move(points);
    tree_.emplace(apart(points_), context);
    aside_ = offset_of(points_);
}

SurfacePoint SheetRest::at_nearest(const Vec3& p) const {
    return tree_->nearest(p + aside_);
}

Vec3 SheetRest::weights_in(std::size_t triangle, const Vec3& p) const {
    const Vec3* corner = &points_[3 * triangle];
    return weights_near(corner[0], corner[1], corner[2], p);
}

std::vector<ElementMap::Source> SheetRest::vertex_sources(const Vec3& p) const {
    const SurfacePoint point = at_nearest(p);
    return weighted_sources(vertices[point.face], weights_in(at(point.face), point.position));
}

std::vector<ElementMap::Source> SheetRest::corner_sources(const Vec3& p, const Vec3& middle) const {
    const std::size_t triangle = at(at_nearest(p + kTowards * (middle - p)).face);
    return weighted_sources(corners[triangle], weights_in(triangle, p));
}

}  // namespace lissom
