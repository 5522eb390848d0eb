/// SheetRest: the triangles that a sheet began with, from which values are taken; private to
/// kernel/merge.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/query/spatial_tree.h"

namespace lissom {

class SheetRest {
  public:
    /// By triangle: its face, corners and vertices of the mesh.
    std::vector<Index> face;
    std::vector<Triangle> corners, vertices;

    /// Finishes a rest shape with the positions of its triangles' corners, three each. Errors:
    /// cancelled.
    void set_points(std::vector<Vec3> points, const Context& context);

    Vec3 nearest(const Vec3& p) const { return at_nearest(p).position; }
    /// Returns the vertices of the mesh that a vertex at `p` comes from.
    std::vector<ElementMap::Source> vertex_sources(const Vec3& p) const;
    /// Returns the face of the mesh that a triangle around `middle` comes from.
    Index face_source(const Vec3& middle) const { return face[at_nearest(middle).face]; }
    /// Returns the corners, of one face of the mesh, that the corner at `p` of a triangle around
    /// `middle` comes from. It is read a little towards the middle, so that it is in its own chart
    /// if two meet.
    std::vector<ElementMap::Source> corner_sources(const Vec3& p, const Vec3& middle) const;

  private:
    SurfacePoint at_nearest(const Vec3& p) const;
    Vec3 weights_in(std::size_t triangle, const Vec3& p) const;

    std::vector<Vec3> points_;
    std::optional<SpatialTree> tree_;
    // Added to points whose nearest triangle is asked for: it turns with the mesh and lies in no
    // plane of symmetry, so that of two equally near triangles rounding does not choose.
    Vec3 aside_ = Vec3::Zero();
};

}  // namespace lissom
