/// A head as a closed surface: heads are often open at the neck, or have holes for the eyes, and
/// their inside must still be known.
#pragma once

#include <cstddef>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/mesh/measure/triangulation.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Triangles without boundary: those of a mesh, then those of caps over its holes. Every edge is
/// run through as often in one direction as in the other, if vertices at equal places count as one,
/// so that the winding number of any point off the surface is an integer.
struct ClosedSurface {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    /// Triangles from this one on are caps.
    std::size_t first_cap = 0;
    /// Volume inside; negative if the mesh faces inward.
    double volume = 0.0;
};

/// Closes the holes of `mesh` by cones to their mean points. Edges that lie on each other in
/// opposite directions (seams) are no holes.
/// Errors: mesh_empty without faces.
ClosedSurface close_surface(const Mesh& mesh);

}  // namespace lissom
