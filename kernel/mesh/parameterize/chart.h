/// A piece of surface about to be laid out in the plane; private to kernel/mesh.
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

/// Triangles over vertices of their own. Invariant: a connected manifold of genus 0 with at least
/// one boundary.
struct Chart {
    /// Around their mean, so that nothing is lost far from the origin.
    std::vector<Vec3> positions;
    /// Triangles of the faces, then triangles that close holes.
    std::vector<Triangle> triangles;
    /// The vertex of the mesh of each of `positions`, and the face of each of the first triangles.
    std::vector<Index> vertex, face;
    /// Boundaries of the faces, and of all triangles: the longest first.
    std::vector<std::vector<Index>> loops, open_loops;

    Index vertex_count() const { return count_of(positions); }
    Index triangle_count() const { return count_of(triangles); }
    bool is_fill(Index triangle) const { return triangle >= count_of(face); }
};

/// The faces, and `fill`, which are triangles over vertices of the mesh; then with `close_holes`
/// triangles of least area over every boundary but the longest. Errors: as `parameterize`.
Chart make_chart(const Mesh& mesh, std::span<const Index> faces, std::span<const Triangle> fill,
                 bool close_holes, const Context& context);

/// Length of a closed line through positions of the chart.
double loop_length(const Chart& chart, std::span<const Index> loop);

}  // namespace lissom
