/// Polygons as triangles that a reader can put together again (FB_ngon_encoding); private to
/// kernel/io.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/core/geometry.h"

namespace lissom {

/// Collects the triangles of one primitive. Each polygon is a fan: consecutive triangles with the
/// same first vertex, which differs from that of the polygon before.
class FanWriter {
  public:
    /// Result for a polygon: the faces that a reader will find, and the position of the polygon's
    /// first corner, counted from the first vertex of the first of them.
    struct Added {
        Index parts = 1;
        Index turn = 0;
    };
    /// Adds a polygon of pool vertices `vertices` at `points`. A triangle of a surface of triangles
    /// keeps its first vertex. There are several parts if no fan covers the polygon.
    Added add(const std::vector<Index>& vertices, const std::vector<Vec3>& points);

    /// Three vertices a triangle.
    const std::vector<Index>& corners() const { return corners_; }
    /// Returns true if a polygon has more than three corners, so that the encoding has to be
    /// declared.
    bool has_polygons() const { return has_polygons_; }
    /// Tells that polygons will come, before the first is added: triangles too then need different
    /// first vertices.
    void expect_polygons() { has_polygons_ = true; }

  private:
    void add_fan(const std::vector<Index>& vertices, std::size_t start);

    std::vector<Index> corners_;
    Index last_first_ = kNoIndex;
    bool has_polygons_ = false;
};

}  // namespace lissom
