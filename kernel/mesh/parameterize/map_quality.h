/// Quality of a map of a chart into the plane; private to kernel/mesh.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/parameterize/chart.h"
#include "kernel/mesh/parameterize/triangle_shape.h"

namespace lissom {

/// Triangles that are not counter-clockwise, ascending.
std::vector<Index> flipped_triangles(std::span<const Triangle> triangles, std::span<const Vec2> uv);

/// Pairs of edges of closed lines that cross; edges with a common vertex do not count.
Index crossing_edges(std::span<const std::vector<Index>> loops, std::span<const Vec2> uv);

/// Least and greatest singular value over the faces' triangles that are not degenerate.
struct ScaleRange {
    double least = 1.0, greatest = 1.0;
};
ScaleRange scale_range(const Chart& chart, const std::vector<TriangleShape>& shapes,
                       std::span<const Vec2> uv);

/// Scales a map about the origin so that the faces have as much area as on the surface.
void scale_to_area(const Chart& chart, const std::vector<TriangleShape>& shapes,
                   std::vector<Vec2>& uv);

/// Moves the mean of the longest open loop, by length on the surface, to the origin, and turns its
/// lowest vertex onto the positive u axis.
void place_by_outline(const Chart& chart, std::vector<Vec2>& uv);

}  // namespace lissom
