/// Triangulation in memory of the caller, for frames; private to the kernel.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/ear_walk.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// Memory that triangulations take, kept from one to the next.
struct TriangulationRoom {
    std::vector<Vec3> points;
    std::vector<Triangle> local;
    std::vector<Index> loop;
    EarRoom ears;
};

/// As triangulate_polygon, in the memory of `room`.
void triangulate_polygon(std::span<const Vec3> points, std::vector<Triangle>& triangles,
                         TriangulationRoom& room);

/// Makes `result` the triangulation of the given faces, in the memory that it and `room` have.
void triangulate_faces(const Topology& topology, std::span<const Vec3> positions,
                       std::span<const Index> faces, Triangulation& result,
                       TriangulationRoom& room);

}  // namespace lissom
