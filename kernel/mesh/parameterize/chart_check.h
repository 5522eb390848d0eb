/// Requirements of triangles that are to be laid out in the plane; private to kernel/mesh.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {

/// Boundaries of triangles over `vertex_count` vertices, all of them used, in the direction of the
/// triangles, each from its lowest vertex and ordered by it. `id` are the numbers by which errors
/// name the vertices. Errors: nonmanifold_edge if more than two triangles share an edge or two turn
/// differently; nonmanifold_vertex if triangles meet at a vertex only; not_a_disk if they fall into
/// parts, have no boundary, or have handles.
std::vector<std::vector<Index>> boundaries_of_chart(std::span<const Triangle> triangles,
                                                    std::span<const Index> id);

}  // namespace lissom
