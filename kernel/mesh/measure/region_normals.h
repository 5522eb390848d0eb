/// Vertex normals of a part of a mesh that moves: indexed once, then evaluated for each frame.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/core/memory_hold.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Normals of the vertices of a region by the rule of `vertex_normals`, equal to them within 1e-14.
/// Faces that lie partly outside count; their vertices outside stay in place.
/// Works on polygons of all kinds. `evaluate` allocates nothing.
class RegionNormals {
  public:
    /// `position_outside(v)` returns the place of a vertex next to the region. Errors:
    /// memory_limit.
    RegionNormals(const Region& region, const std::function<Vec3(Index)>& position_outside,
                  const Context& context = {});

    /// Returns the unit normal of each vertex of the region, in the order of its vertices, as
    /// `positions` are; zero if no face around a vertex has an area. Valid until the next call. The
    /// same for any number of threads. Errors: invalid_argument for another number of positions;
    /// cancelled.
    const std::vector<Vec3>& evaluate(std::span<const Vec3> positions, const Context& context = {});

  private:
    void charge(const Region& region, std::span<const Index> faces);
    void add_corners_of_rows();
    void measure_face(Index f);
    /// These measure a face times `scale`. Return whether its size suits products of lengths.
    bool measure_triangle(Index f, double scale);
    bool measure_polygon(Index f, double scale);
    Vec3 sum_at(Index row) const;

    MemoryHold hold_;
    /// Vertices of the region, then those next to it.
    std::vector<Vec3> points_;
    Index rows_ = 0;
    /// Corners of face f are [face_begin_[f], face_begin_[f + 1]).
    std::vector<Index> face_begin_{0}, corner_vertex_;
    /// Corners at each row and their faces, in the order of the faces.
    std::vector<Index> row_begin_, row_corner_, row_face_;
    std::vector<Vec3> face_normal_, row_normal_;
    std::vector<double> corner_angle_;
};

}  // namespace lissom
