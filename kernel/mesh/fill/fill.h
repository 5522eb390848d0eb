/// Filling of holes.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/fill/fairing.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/path.h"

namespace lissom {

/// Triangles that close a hole before refinement.
enum class FillMethod {
    /// The least largest dihedral angle, then the least area (Liepa 2003): continues the surface.
    angle,
    /// The least area: a lid.
    area,
};

struct FillOptions {
    FillMethod method = FillMethod::angle;
    /// Inserts vertices until the patch is as dense as the mesh around the hole.
    bool subdivide = true;
    /// Density relative to the mesh around the hole; above 0. More than 1 lets a patch bend
    /// whose rim has few vertices.
    double density = 1.0;
    /// Moves the inserted vertices so that the patch continues the surface smoothly (a bi-Laplacian
    /// system over them); without it they stay in the flat pieces of the coarse patch.
    bool fair = true;
    /// Continuity with the surface around. With `curvature` a large patch in a round surface is
    /// round, but on rough surfaces it extends the little that is known at its rim.
    FairContinuity continuity = FairContinuity::tangents;
    /// Vertices that refinement may insert at most; it stops there and the report says so.
    Index maximum_vertices = 200000;
};

/// Report of a closed hole. Old ids stay; new ones follow them.
struct FillReport {
    /// Vertices around the hole.
    Index loop_size = 0;
    /// Ids added: vertices [first_vertex, first_vertex + vertex_count), faces alike.
    Index first_vertex = 0, vertex_count = 0;
    Index first_face = 0, face_count = 0;
    /// Parts that the loop was divided into before each was triangulated by dynamic programming.
    Index parts = 1;
    /// True if refinement ended at `maximum_vertices`.
    bool limit_reached = false;
    /// Edges of the patch whose faces turn by more than 150 degrees, its seam included.
    Index folded_edges = 0;
};

/// Closes one open boundary of `mesh`, in place, by triangles: minimum-weight triangulation,
/// refinement, fairing (Liepa 2003). The dynamic programme is cubic: a loop of more than 300 edges
/// is first divided by short chords, or with `area` triangulated as `minimum_area_triangles` says.
/// The topology is a new one; named regions move to it, and a new vertex is in the regions that
/// contain all its sources. Vertex attributes of new vertices are blended from the loop; corner and
/// face attributes of new faces are NaN and their labels none. Offsets of morph targets go through
/// refinement and fairing with the weights of the positions. Errors: topology_mismatch;
/// invalid_argument if `boundary` is not an open boundary of the mesh, or options are out of range;
/// memory_limit; cancelled. The mesh is then unchanged.
FillReport fill(Mesh& mesh, const Path& boundary, const FillOptions& options = {},
                const Context& context = {});

}  // namespace lissom
