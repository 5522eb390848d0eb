/// Slides vertices along their edges onto a contour that passes close by, so that cutting along it
/// leaves no slivers; private to kernel/mesh.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/cut/contour.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Vertices moved onto the contour.
struct Slides {
    /// For each vertex the crossing that it was moved to, or kNoIndex.
    std::vector<Index> crossing_of;

    bool has(Index v) const { return crossing_of[at(v)] != kNoIndex; }
};

/// Chooses the vertices to slide: nearest crossings first, those within `limit` of an edge's
/// length. A vertex stays if otherwise the contour would no longer be a simple line, a face would
/// turn over, become thin or leave the surface, a vertex would leave an open boundary, or an
/// attribute's seam would be displaced. `side` tells for each vertex the side of the lines it is
/// on. Crossings very close to a vertex that stays are moved away from it.
Slides slide_vertices(const Mesh& mesh, const std::vector<ContourLine>& lines,
                      const std::vector<signed char>& side, double limit, CrossedEdges& crossed,
                      const Context& context);

/// Position of `v` after sliding.
Vec3 position_after(const Mesh& mesh, const Slides& slides, const CrossedEdges& crossed, Index v);

/// For each face around a vertex, in the order of Topology::faces_around, the two corners that the
/// corner of that face at the vertex lies between once it has slid along the edge to `toward`:
/// those of the nearest face with that edge that no seam of corner attributes or labels separates
/// from it; nothing if there is none.
using CornerPair = std::array<Index, 2>;
std::vector<std::optional<CornerPair>> corners_along(const Mesh& mesh, Index v, Index toward);

}  // namespace lissom
