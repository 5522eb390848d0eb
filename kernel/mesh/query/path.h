/// Path: an open or closed polyline, either through vertices of a mesh or of free points in space.
/// A boundary is a closed path through vertices.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"
#include "kernel/mesh/topology.h"

namespace lissom {

/// The point of a polyline nearest to a given one.
struct PathPoint {
    /// Fraction of the path's length from its start to the point, 0 to 1.
    double parameter = 0.0;
    /// The point lies between point `segment` and the next.
    Index segment = 0;
    Vec3 point = Vec3::Zero();
    double distance = 0.0;
};

class Path {
  public:
    /// A path through vertices; consecutive ones differ but need not share an edge. At least 2
    /// vertices, at least 3 if closed (the first is not repeated at the end). Errors:
    /// invalid_argument; out_of_range naming the vertices.
    Path(std::shared_ptr<const Topology> topology, std::vector<Index> vertices, bool closed);
    /// A path of free points. At least 2 points, at least 3 if closed. Errors: invalid_argument;
    /// not_finite.
    Path(std::vector<Vec3> points, bool closed);

    bool closed() const { return closed_; }
    /// Number of points or vertices.
    Index size() const;
    Index segment_count() const { return closed_ ? size() : size() - 1; }

    /// Returns true if the path runs through vertices of a mesh.
    bool on_mesh() const { return topology_ != nullptr; }
    /// Returns the topology whose vertices it runs through; null for free points.
    const std::shared_ptr<const Topology>& topology() const { return topology_; }
    /// Vertices in order; empty for free points.
    const std::vector<Index>& vertices() const { return vertices_; }
    /// Returns true if every segment is an edge of the mesh.
    bool follows_edges() const;
    /// Returns true if the path is one of the open boundaries of its topology, in either direction
    /// and from any start.
    bool is_boundary() const;

    /// Returns positions along the path: of its vertices in `mesh`, or its own points for any mesh.
    /// Errors: topology_mismatch.
    std::vector<Vec3> points(const Mesh& mesh) const;
    /// Returns its own points. Errors: invalid_argument if the path runs through vertices.
    const std::vector<Vec3>& points() const;

    /// Length of the polyline. Errors: as `points`.
    double length(const Mesh& mesh) const;
    double length() const;

    /// Returns the point of the polyline nearest to `p`; the first of ties. Errors: as `points`.
    PathPoint nearest(const Mesh& mesh, const Vec3& p) const;
    PathPoint nearest(const Vec3& p) const;

    /// Returns the same path run the other way; a closed one starts at the same point.
    Path reversed() const;

  private:
    friend void smooth_path(Path& path, Index iterations, double strength);

    std::shared_ptr<const Topology> topology_;
    std::vector<Index> vertices_;
    std::vector<Vec3> points_;
    bool closed_ = false;
};

/// Returns the open boundaries of a mesh, each a closed path with the surface on its left, in the
/// order of Topology::boundary_loops.
std::vector<Path> boundaries(const Mesh& mesh);

/// Returns the open boundary of a mesh that has exactly one. Errors: not_a_boundary if it has none;
/// boundary_conflict if it has several.
Path boundary(const Mesh& mesh);

/// Returns the loops around the faces of a region, as Region::boundaries.
std::vector<Path> boundaries(const Region& region);

/// Returns the shortest path along edges that visits `vertices` in order, and the first again if
/// `closed`. Errors: out_of_range; invalid_argument for fewer than 2 vertices, for equal
/// neighbours, or if two lie in different components; cancelled.
Path path_through(const Mesh& mesh, std::span<const Index> vertices, bool closed,
                  const Context& context = {});

/// Smooths a curve: each iteration moves every point by `strength` (0 to 1) of the way to the
/// middle of its neighbours along the path. Ends of open paths stay; closed ones shrink slowly. The
/// first form moves the mesh's vertices under a path ("normal" attributes turn with the surface),
/// the second the points of a free one.
/// Errors: topology_mismatch; invalid_argument for options out of range or the wrong kind of path.
void smooth_path(Mesh& mesh, const Path& path, Index iterations = 10, double strength = 0.5);
void smooth_path(Path& path, Index iterations = 10, double strength = 0.5);

}  // namespace lissom
