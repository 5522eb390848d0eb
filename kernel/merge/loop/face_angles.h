/// Directions of faces and angles between them; private to kernel/merge.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/edges.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Along the normal of a face; its length is twice the face's area.
inline Vec3 area_vector(const Mesh& mesh, Index face) {
    const std::span<const Index> vertices = mesh.topology().face(face);
    const Vec3& origin = mesh.position(vertices[0]);
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 1; k + 1 < vertices.size(); ++k) {
        sum += (mesh.position(vertices[k]) - origin).cross(mesh.position(vertices[k + 1]) - origin);
    }
    return sum;
}

/// The same, but zero for a face without area, whose normal would be one of rounding errors.
inline Vec3 clear_area_vector(const Mesh& mesh, Index face) {
    constexpr double kClear = 1e-10;
    const std::span<const Index> vertices = mesh.topology().face(face);
    double longest = 0.0;
    for (std::size_t k = 1; k < vertices.size(); ++k) {
        const Vec3 side = mesh.position(vertices[k]) - mesh.position(vertices[0]);
        longest = std::max(longest, side.squaredNorm());
    }
    const Vec3 area = area_vector(mesh, face);
    return area.norm() > kClear * longest ? area : Vec3(Vec3::Zero());
}

/// The same number for an edge in either direction, and no other.
inline std::uint64_t edge_key(Index a, Index b) {
    return pair_key(std::min(a, b), std::max(a, b));
}

/// In radians, 0 to pi.
inline double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The greatest of angles between vectors, and 0 of none. Only a candidate for the greatest costs
/// an arc tangent.
class GreatestAngle {
  public:
    void add(const Vec3& a, const Vec3& b) {
        const double sine = a.cross(b).norm(), cosine = a.dot(b);
        const double rounding = kRounding * (sine + std::abs(cosine)) * (sine_ + std::abs(cosine_));
        if (sine * cosine_ - cosine * sine_ < -rounding) return;
        const double angle = std::atan2(sine, cosine);
        if (!(angle > angle_)) return;
        angle_ = angle;
        sine_ = sine;
        cosine_ = cosine;
    }
    /// An angle that is known, in radians.
    void add(double angle) {
        if (!(angle > angle_)) return;
        angle_ = angle;
        sine_ = std::sin(angle);
        cosine_ = std::cos(angle);
    }
    double value() const { return angle_; }

  private:
    static constexpr double kRounding = 1e-12;
    double angle_ = 0.0, sine_ = 0.0, cosine_ = 0.0;
};

/// The smallest angle of a triangle.
inline double smallest_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
    // It is opposite the shortest side, if that is clear and more than rounding.
    constexpr double kClearlyLonger = 1.001, kClearAngle = 1e-9;
    const double ab = (b - a).squaredNorm(), bc = (c - b).squaredNorm(), ca = (a - c).squaredNorm();
    const double at_a = kClearlyLonger * bc, at_b = kClearlyLonger * ca, at_c = kClearlyLonger * ab;
    double angle = 0.0;
    if (at_a < ab && at_a < ca) angle = angle_between(b - a, c - a);
    if (at_b < ab && at_b < bc) angle = angle_between(c - b, a - b);
    if (at_c < bc && at_c < ca) angle = angle_between(a - c, b - c);
    if (angle > kClearAngle) return angle;
    return std::min(
        {angle_between(b - a, c - a), angle_between(c - b, a - b), angle_between(a - c, b - c)});
}

/// Adds the dihedral angle at the edge between two vertices: none at an open edge, and next to a
/// face without area.
inline void add_edge_dihedral(const Mesh& mesh, Index a, Index b, GreatestAngle& greatest) {
    const Index left = face_left_of(mesh.topology(), a, b);
    const Index right = face_left_of(mesh.topology(), b, a);
    if (left == kNoIndex || right == kNoIndex) return;
    const Vec3 n = clear_area_vector(mesh, left), m = clear_area_vector(mesh, right);
    if (n.squaredNorm() > 0.0 && m.squaredNorm() > 0.0) greatest.add(n, m);
}

/// That angle, or 0.
inline double edge_dihedral(const Mesh& mesh, Index a, Index b) {
    GreatestAngle angle;
    add_edge_dihedral(mesh, a, b, angle);
    return angle.value();
}

/// The smallest angle of a face.
inline double smallest_face_angle(const Mesh& mesh, Index face) {
    const std::span<const Index> vertices = mesh.topology().face(face);
    const std::size_t n = vertices.size();
    if (n == 3) {
        return smallest_angle(mesh.position(vertices[0]), mesh.position(vertices[1]),
                              mesh.position(vertices[2]));
    }
    double smallest = kPi;
    for (std::size_t k = 0; k < n; ++k) {
        const Vec3& at = mesh.position(vertices[k]);
        smallest = std::min(smallest, angle_between(mesh.position(vertices[(k + 1) % n]) - at,
                                                    mesh.position(vertices[(k + n - 1) % n]) - at));
    }
    return smallest;
}

}  // namespace lissom
