/// Triangulation of a hole without new vertices; private to kernel/mesh.
#pragma once

#include <span>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/fill/hole_patch.h"

namespace lissom {

/// Adds triangles that close `loop` to the patch: least maximum dihedral angle, then least area, by
/// dynamic programming (Liepa 2003, section 3; Barequet and Sharir 1995). The loop runs in the
/// direction of the triangles. Existing edges are not used again; if that leaves no triangulation,
/// a fan around a new vertex in the middle closes the hole. A loop of more than 300 edges is
/// divided by short chords first. Returns the number of parts.
Index triangulate_hole(HolePatch& patch, std::span<const Index> loop, const Context& context);

/// Adds them by `minimum_area_triangles` instead: least area.
void triangulate_hole_by_area(HolePatch& patch, std::span<const Index> loop,
                              const Context& context);

}  // namespace lissom
