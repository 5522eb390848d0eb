/// Directions of faces and angles between them; private to kernel/merge.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "kernel/mesh/mesh.h"

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

/// In radians, 0 to pi.
inline double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace lissom
