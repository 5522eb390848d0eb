/// Places of roots on the mesh of a head.
#pragma once

#include <optional>
#include <span>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/hair/scalp/roots.h"
#include "kernel/hair/strands/strands.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Returns faces and barycentric coordinates of roots on `head`, and their triangles if any of
/// their faces has more than three corners. A root without a face has kNoIndex and weights of 0.
/// Texture coordinates are left out.
StrandRoots roots_on(const Mesh& head, std::span<const Root> roots);

/// Returns the vertices that the weights of a root belong to; nothing if the strand has no face,
/// or one that `head` does not have.
std::optional<Triangle> root_triangle(const StrandRoots& roots, Index strand, const Mesh& head);

/// Returns the place of a root on `head`, in its unit; nothing as for root_triangle.
std::optional<Vec3> root_place(const StrandRoots& roots, Index strand, const Mesh& head);

}  // namespace lissom
