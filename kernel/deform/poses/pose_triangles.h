/// The triangles of a surface that takes poses, and how they hang together; private to
/// kernel/deform.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Two edges of a triangle: from its corner 0 to 1, and from 1 to 2.
struct TriangleEdges {
    Vec3 first = Vec3::Zero(), second = Vec3::Zero();
};

/// The triangles of a mesh at rest. After them come links: one for each smaller component that
/// sits on the largest one, such as an eye. A link is a triangle of an edge of the surface below
/// the component, its host, and of the component's nearest vertex, and it turns as its host does.
struct PoseTriangles {
    std::vector<Triangle> triangles;
    /// Weights in the energy, of the edges from corner k to k + 1. Cotangents of the angle opposite
    /// within bounds, so that slivers and obtuse triangles keep the system definite.
    std::vector<std::array<double, 3>> weight;
    /// The triangle across each edge, or kNoIndex. Links have none.
    std::vector<std::array<Index, 3>> neighbor;
    /// The hosts of links, which are the last triangles.
    std::vector<Index> hosts;
    /// The component whose place each component takes: its own, or that of the host of its link.
    std::vector<Index> base;

    Index surface_count() const { return count_of(triangles) - count_of(hosts); }
};

/// Triangulates a mesh and finds its links. Errors: memory_limit; cancelled.
PoseTriangles pose_triangles(const Mesh& rest, const Context& context);

/// The edges of a triangle in the shape `positions`.
TriangleEdges edges_of(const Triangle& triangle, std::span<const Vec3> positions);

/// The edges, and a normal as long as the root of their area, so that scaling scales it too.
Mat3 edge_frame(const TriangleEdges& edges);

/// Whether the edges of a triangle are parallel, or it has none, so that it has no normal.
bool is_flat(const TriangleEdges& edges);

}  // namespace lissom
