/// Triangulation of a mesh's polygons, for operators that need triangles. It depends on the
/// positions: a quad is split along its shorter diagonal, larger polygons by ear clipping in their
/// mean plane, the best ears first up to 32 corners. The time for larger ones grows about as n log
/// n in the number of their corners.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/topology.h"

namespace lissom {

using Triangle = std::array<Index, 3>;

/// Triangles of one polygon as local corner numbers (0 .. n - 1); n - 2 of them are appended to
/// `triangles`. The choice does not change under similarities of the points, up to rounding.
void triangulate_polygon(std::span<const Vec3> points, std::vector<Triangle>& triangles);

/// A triangulation of faces, with the face of each triangle.
struct Triangulation {
    std::vector<Triangle> triangles;
    /// For each triangle, the face it is part of.
    std::vector<Index> face;
    /// For each triangle, the corners of the mesh at its three vertices.
    std::vector<Triangle> corners;
};

/// Triangulates the given faces, or all of them.
Triangulation triangulate_faces(const Topology& topology, std::span<const Vec3> positions,
                                std::span<const Index> faces);
Triangulation triangulate_faces(const Topology& topology, std::span<const Vec3> positions);

}  // namespace lissom
