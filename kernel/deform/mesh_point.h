/// Points of a mesh by its vertices, which a deformation can hold: vertices, points of edges and
/// points inside faces.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/path.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// The mean of vertices of one face with weights that sum to 1: it moves with
/// them.
struct MeshPoint {
    std::vector<Index> vertices;
    std::vector<double> weights;

    bool operator==(const MeshPoint&) const = default;

    /// Returns its position. Errors: out_of_range.
    Vec3 position(const Mesh& mesh) const;
};

/// The vertex `v`.
MeshPoint vertex_point(Index v);
/// The point at the fraction `t` of the way from vertex `a` to vertex `b` of an edge.
MeshPoint edge_point(Index a, Index b, double t);
/// The point of a face whose corners have the given weights, in the order of its vertices.
/// Errors: out_of_range; invalid_argument unless there is one weight a corner.
MeshPoint face_point(const Topology& topology, Index face, std::span<const double> weights);
/// Returns the point that SpatialTree found.
MeshPoint mesh_point(const SurfacePoint& point);

/// The points that a path runs through: its vertices, or the points of the mesh nearest to its own
/// points. Repeats are left out. Errors: topology_mismatch; mesh_empty.
std::vector<MeshPoint> path_points(const Mesh& mesh, const Path& path, const Context& context = {});

/// Returns the point without vertices of weight zero, in ascending order of vertices, with weights
/// that sum to 1 exactly. Errors: out_of_range; invalid_argument if the weights are negative, not
/// finite, or do not sum to 1, or if no face has all the vertices.
MeshPoint checked_point(const Topology& topology, const MeshPoint& point);

}  // namespace lissom
