/// A surface with fewer vertices, for deformations of very many; private to kernel/deform.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Some vertices of a surface, in their places, joined by larger triangles.
struct ThinnedSurface {
    Mesh mesh;
    /// The given vertex that each vertex of `mesh` is.
    std::vector<Index> from;
    /// The vertex of `mesh` that each given one was merged into; kNoIndex for one without faces.
    std::vector<Index> onto;
};

/// Merges vertices with a near neighbour of the same part, shortest edges first and evenly spread,
/// until `wanted` are left, or as many as can be. `part` has a number for each vertex of
/// `triangles`; vertices beside another part stay, and so do open borders. The topology stays, and
/// no triangle turns by more than 78 degrees in a step. Errors: cancelled; memory_limit.
ThinnedSurface thinned_surface(const Mesh& triangles, std::span<const Index> part, Index wanted,
                               const Context& context);

}  // namespace lissom
