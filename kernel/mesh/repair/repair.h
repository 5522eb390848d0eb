/// Check and repair: makes an oriented 2-manifold of any polygons, and reports the changes.
///
/// Nothing is moved. Vertices and faces that survive keep their order; vertices that had to be
/// split get their copies at the end. Attributes, labels and regions of the soup follow; a vertex
/// attribute with different values among welded vertices becomes one of corners.
#pragma once

#include "kernel/core/context.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/report.h"
#include "kernel/mesh/soup.h"

namespace lissom {

/// Vertices at the same place (equal coordinates) that become one.
enum class Weld {
    none,
    /// Edges that join two boundary edges at the same place and of opposite direction, as along a
    /// seam of texture coordinates. Surfaces that merely touch, as closed lips do, stay apart; so
    /// do the two sides of a doubled sheet and faces with different labels "object".
    seams,
    /// All, as in files that store each triangle by itself.
    all,
};

/// Treatment of vertices that no face uses.
enum class UnusedVertices {
    drop,
    /// Keeps their order: programs that match vertices by number, as those of morph targets
    /// do, find the count of the file. Without welding and defects all vertices keep their numbers.
    keep,
};

struct RepairOptions {
    Weld weld = Weld::seams;
    /// False: each defect is an error instead of a repair, and so are faces without area.
    bool repair = true;
    UnusedVertices unused = UnusedVertices::drop;
};

/// Returns the mesh of `soup`; its report() starts with the findings of `report`. Faces are, in
/// this order: freed of repeated corners, split at pinches, dropped if collapsed or duplicate, cut
/// apart at edges of more than two (faces that bound the same piece of space stay together),
/// oriented like their neighbours (a closed piece that had to be reoriented faces outward, an open
/// one as most of its area did), and vertices are split into one for each fan. Vertices without
/// faces are dropped, unless `unused` keeps them or there is no face at all. Errors: face_index;
/// not_finite; invalid_argument for attributes that do not fit; cancelled; and without `repair`:
/// face_too_small, repeated_vertex, duplicate_face, nonmanifold_edge, inconsistent_orientation,
/// nonmanifold_vertex, unreferenced_vertex, zero_area.
Mesh repair(Soup soup, const RepairOptions& options = {}, const Context& context = {},
            Report report = {});

}  // namespace lissom
