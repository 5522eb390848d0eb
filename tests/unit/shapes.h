/// Shapes that the tests of several modules use.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/shapes/shapes.h"

namespace lissom::test {

/// A tube of `rings` rings of `count` vertices around z: its lower boundary loop is vertices 0 to
/// count - 1, and `shape(angle, height)` with height from 0 to 1 places them.
inline Mesh tube(Index count, Index rings, const std::function<Vec3(double, double)>& shape) {
    std::vector<Vec3> positions;
    FaceList faces;
    for (Index r = 0; r < rings; ++r) {
        for (Index k = 0; k < count; ++k) {
            positions.push_back(shape(2.0 * kPi * k / count, static_cast<double>(r) / (rings - 1)));
        }
    }
    for (Index r = 0; r + 1 < rings; ++r) {
        for (Index k = 0; k < count; ++k) {
            const Index next = (k + 1) % count, a = r * count;
            faces.add({a + k, a + next, a + count + next});
            faces.add({a + k, a + count + next, a + count + k});
        }
    }
    return Mesh(std::move(positions), std::move(faces));
}

/// A tube around y, open at both ends and centered at the origin.
inline Mesh open_tube(Index segments, Index rings, double height = 2.0, double radius = 1.0) {
    return make_cylinder(
        {.radius = radius, .height = height, .segments = segments, .rings = rings, .caps = false});
}

inline Mesh moved(Mesh mesh, const Affine& map) {
    for (Vec3& p : mesh.edit_positions()) p = map(p);
    return mesh;
}

/// A round tube of radius 1 and height 2.
inline Mesh round_tube(Index count, Index rings) {
    return tube(count, rings, [](double angle, double height) {
        return Vec3(std::cos(angle), std::sin(angle), 2.0 * height);
    });
}

}  // namespace lissom::test
