#include "kernel/hair/follow/skin_contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace lissom {
namespace {

// A foot with a smaller weight lies on an edge.
constexpr double kOnSkinEdge = 1e-9;

std::vector<Vec3> skin_normals(std::span<const Vec3> places, const Triangulation& triangles) {
    std::vector<Vec3> normals(places.size(), Vec3::Zero());
    for (const auto& [i, j, k] : triangles.triangles) {
        const Vec3 normal = (places[at(j)] - places[at(i)]).cross(places[at(k)] - places[at(i)]);
        for (const Index v : {i, j, k}) normals[at(v)] += normal;
    }
    return normals;
}

Vec3 unit_or_zero(const Vec3& v) {
    const double size = v.norm();
    return size > 0.0 ? Vec3(v / size) : Vec3::Zero();
}

}  // namespace

SkinSurface::SkinSurface(std::vector<Vec3> places, const Triangulation& triangles,
                         const Topology& topology, double sign, const Context& context)
    : topology_(topology),
      normals_(skin_normals(places, triangles)),
      sign_(sign),
      tree_(std::move(places), triangles.triangles, context) {}

std::optional<SurfacePoint> SkinSurface::nearest(const Vec3& point, double reach) const {
    return tree_.nearest_within(point, reach);
}

// Whether it lies on an open edge, beyond which there is no inside.
bool SkinSurface::is_open(const SurfacePoint& foot) const {
    if (foot.barycentric.minCoeff() > kOnSkinEdge) return false;
    for (int c = 0; c < 3; ++c) {
        const bool touches = foot.barycentric[c] > kOnSkinEdge;
        if (touches && !topology_.is_boundary(foot.triangle[at(c)])) return false;
    }
    return true;
}

std::optional<SkinHeight> SkinSurface::height(const Vec3& point, double reach) const {
    const auto foot = tree_.nearest_within(point, reach);
    if (!foot || is_open(*foot)) return std::nullopt;
    Vec3 normal = foot->normal;
    if (foot->barycentric.minCoeff() <= kOnSkinEdge) {
        normal = Vec3::Zero();
        for (int c = 0; c < 3; ++c) {
            normal += foot->barycentric[c] * unit_or_zero(normals_[at(foot->triangle[at(c)])]);
        }
        normal = unit_or_zero(normal);
    }
    normal *= sign_;
    const double side = normal.dot(point - foot->position);
    return SkinHeight{std::copysign(foot->distance, side), normal};
}

}  // namespace lissom
