/// Distances over the surface of a mesh: along edges (Dijkstra) and geodesic (the heat method).
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {

/// Length of the shortest way along edges from any of `sources` to every vertex; infinity for
/// vertices out of reach or beyond `limit`. The work is proportional to the number of elements
/// within the limit, apart from filling the result. Errors: out_of_range; invalid_argument for a
/// limit that is negative or NaN; cancelled.
std::vector<double> edge_distances(const Mesh& mesh, std::span<const Index> sources,
                                   double limit = std::numeric_limits<double>::infinity(),
                                   const Context& context = {});

/// Returns the same from a point of the surface: straight to a corner of its triangle, then along
/// edges.
std::vector<double> edge_distances(const Mesh& mesh, const SurfacePoint& point,
                                   double limit = std::numeric_limits<double>::infinity(),
                                   const Context& context = {});

/// Geodesic distances by the heat method (Crane, Weischedel and Wardetzky 2013), with its two
/// systems factored once for many queries. Polygons are triangulated. The operators are built on
/// the intrinsic Delaunay triangulation after mollification (Sharp and Crane 2020), so that obtuse
/// and nearly degenerate triangles do no harm. At open boundaries the mean of both boundary
/// conditions is used. No distance exceeds the way along edges. Errors are about 1 to 2 % of the
/// farthest distance on meshes of some thousand vertices.
///
///     HeatDistances distances(mesh);
///     const std::vector<double> d = distances.from(std::array{0});
class HeatDistances {
  public:
    /// Takes the present shape of `mesh`, which may change or die afterwards.
    /// Errors: mesh_empty without faces; memory_limit; cancelled.
    explicit HeatDistances(const Mesh& mesh, const Context& context = {});
    ~HeatDistances();
    HeatDistances(HeatDistances&&) noexcept;
    HeatDistances& operator=(HeatDistances&&) noexcept;

    /// Distance of every vertex to the nearest of `sources`: 0 at the sources, infinity in
    /// components without one.
    /// Errors: out_of_range; invalid_argument without sources; cancelled.
    std::vector<double> from(std::span<const Index> sources, const Context& context = {}) const;
    /// Distance of every vertex to a point of the surface, which need not be a vertex.
    /// Errors: out_of_range; cancelled.
    std::vector<double> from_point(const SurfacePoint& point, const Context& context = {}) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Returns one query of HeatDistances. For several queries on one mesh keep the solver.
std::vector<double> heat_distances(const Mesh& mesh, std::span<const Index> sources,
                                   const Context& context = {});

}  // namespace lissom
