#include "kernel/hair/follow/strand_roots.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace lissom {
namespace {

constexpr Triangle kNowhere{kNoIndex, kNoIndex, kNoIndex};

// Weights of the corners of a triangle, in the order of its face.
Eigen::Vector3f corner_weights(const Mesh& head, const Root& root) {
    const std::span<const Index> face = head.topology().face(root.face);
    const Vec3 &a = head.position(face[0]), &b = head.position(face[1]),
               &c = head.position(face[2]);
    const Vec3 normal = (b - a).cross(c - a);
    const double area = normal.squaredNorm();
    if (!(area > 0.0)) return Eigen::Vector3f::Constant(1.0f / 3.0f);
    const double at_b = (root.position - a).cross(c - a).dot(normal) / area;
    const double at_c = (b - a).cross(root.position - a).dot(normal) / area;
    return Vec3(1.0 - at_b - at_c, at_b, at_c).cast<float>();
}

bool is_on_polygon(const Mesh& head, const Root& root) {
    return root.face != kNoIndex && head.topology().face(root.face).size() > 3;
}

bool has_vertices(const Mesh& head, const Triangle& triangle) {
    return std::all_of(triangle.begin(), triangle.end(),
                       [&](Index v) { return v >= 0 && v < head.vertex_count(); });
}

}  // namespace

StrandRoots roots_on(const Mesh& head, std::span<const Root> roots) {
    const bool polygons = std::any_of(roots.begin(), roots.end(),
                                      [&](const Root& root) { return is_on_polygon(head, root); });
    StrandRoots result;
    for (const Root& root : roots) {
        result.faces.push_back(root.face);
        if (polygons) result.triangles.push_back(root.face == kNoIndex ? kNowhere : root.triangle);
        result.barycentrics.push_back(root.face == kNoIndex ? Eigen::Vector3f::Zero()
                                      : polygons            ? root.barycentric.cast<float>().eval()
                                                            : corner_weights(head, root));
    }
    return result;
}

std::optional<Triangle> root_triangle(const StrandRoots& roots, Index strand, const Mesh& head) {
    if (roots.faces.empty()) return std::nullopt;
    const Index face = roots.faces[at(strand)];
    if (face < 0 || face >= head.face_count()) return std::nullopt;
    if (!roots.triangles.empty() && roots.triangles[at(strand)] != kNowhere) {
        const Triangle& triangle = roots.triangles[at(strand)];
        return has_vertices(head, triangle) ? std::optional(triangle) : std::nullopt;
    }
    const auto corners = head.topology().face(face);
    if (corners.size() < 3) return std::nullopt;
    return Triangle{corners[0], corners[1], corners[2]};
}

std::optional<Vec3> root_place(const StrandRoots& roots, Index strand, const Mesh& head) {
    const auto triangle = root_triangle(roots, strand, head);
    if (!triangle) return std::nullopt;
    Vec3 place = Vec3::Zero();
    for (int c = 0; c < 3; ++c) {
        place += double{roots.barycentrics[at(strand)][c]} * head.position((*triangle)[at(c)]);
    }
    return place;
}

}  // namespace lissom
