#include "kernel/hair/follow/skin_contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace lissom {
namespace {

constexpr Index kBindGrain = 64;
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

bool has_normals(const HeadMotion& head, const Triangle& triangle) {
    return std::none_of(triangle.begin(), triangle.end(),
                        [&](Index v) { return head.rest_normals()[at(v)].isZero(0.0); });
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

SkinBinding::SkinBinding(const Strands& strands, const SkinSurface& skin, const HeadMotion& head,
                         double reach, const Context& context) {
    std::vector<std::vector<SkinPlace>> lists(at(strands.size()));
    context.parallel_for(0, strands.size(), kBindGrain, [&](Index begin, Index end) {
        for (Index s = begin; s < end; ++s) {
            const StrandView strand = strands.strand(s);
            for (Index k = 1; k < strands.point_count(s); ++k) {
                const Vec3 point = point_of(strand, k);
                const auto foot = point.allFinite() ? skin.nearest(point, reach) : std::nullopt;
                if (!foot || !has_normals(head, foot->triangle)) continue;
                SkinPlace place{.point = k};
                for (std::size_t c = 0; c < 3; ++c) {
                    place.vertices[c] = static_cast<std::uint32_t>(foot->triangle[c]);
                    place.weights[c] = static_cast<float>(foot->barycentric[index_of(c)]);
                }
                place.height = static_cast<float>(height(place, point, head).height);
                lists[at(s)].push_back(place);
            }
        }
    });
    first_.push_back(0);
    for (const std::vector<SkinPlace>& list : lists) first_.push_back(first_.back() + list.size());
    charge_ = context.charge(first_.back() * sizeof(SkinPlace), "hair near the skin");
    places_.reserve(first_.back());
    for (const std::vector<SkinPlace>& list : lists) {
        places_.insert(places_.end(), list.begin(), list.end());
    }
}

SkinHeight SkinBinding::height(const SkinPlace& place, const Vec3& point, const HeadMotion& head) {
    Vec3 foot = Vec3::Zero(), normal = Vec3::Zero();
    for (std::size_t c = 0; c < 3; ++c) {
        const double weight = place.weights[c];
        foot += weight * head.places()[place.vertices[c]];
        normal += head.outward() * weight * head.normals()[place.vertices[c]];
    }
    normal = unit_or_zero(normal);
    return {normal.dot(point - foot), normal};
}

float SkinBinding::quick_height(const SkinPlace& place, const float* point,
                                const HeadMotion& head) {
    Eigen::Array4f foot(-point[0], -point[1], -point[2], 0.0f), normal = Eigen::Array4f::Zero();
    for (std::size_t c = 0; c < 3; ++c) {
        const HeadMotion::SkinVertex& vertex = head.skin()[place.vertices[c]];
        foot += place.weights[c] * vertex.place;
        normal += place.weights[c] * vertex.normal;
    }
    const float size = (normal * normal).sum();
    return size > 0.0f ? -(normal * foot).sum() / std::sqrt(size) : 0.0f;
}

}  // namespace lissom
