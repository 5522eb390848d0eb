/// A closed cylinder in two halves, for tests of measures around a seam.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/shapes/shapes.h"

namespace lissom::test {

/// Radius 1, from y = -2 to 2, with the circle at y = 0 as its seam.
struct SeamColumn {
    Mesh mesh;
    /// Vertices in the order of their angles.
    std::vector<Index> seam;
    /// Faces.
    std::vector<Index> below, above;

    SeamColumn(Index around, Index rows)
        : mesh(make_cylinder({.radius = 1.0, .height = 4.0, .segments = around, .rings = rows})) {
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            if (std::abs(mesh.position(v).y()) < 1e-9) seam.push_back(v);
        }
        const auto angle = [&](Index v) {
            return std::atan2(mesh.position(v).x(), mesh.position(v).z());
        };
        std::sort(seam.begin(), seam.end(), [&](Index a, Index b) { return angle(a) < angle(b); });
        for (Index f = 0; f < mesh.face_count(); ++f) {
            double y = 0.0;
            for (const Index v : mesh.topology().face(f)) y += mesh.position(v).y();
            (y < 0.0 ? below : above).push_back(f);
        }
    }

    /// Returns the mesh with each position changed by `move`.
    template <typename Move>
    Mesh moved(const Move& move) const {
        Mesh made = mesh;
        for (Vec3& p : made.edit_positions()) move(p);
        return made;
    }
};

}  // namespace lissom::test
