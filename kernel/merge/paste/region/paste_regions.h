/// The regions of a paste: the pasted part, the ring around it in which the boundary is sought, and
/// the place on the target (thesis section 3.4.1); private to kernel/merge.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Marks on the source of a paste.
struct PasteMarks {
    const Region& region;
    /// Without one it is the part farther from the region's outline, along edges, than `share`, 0
    /// to 1, of the way to the farthest vertex or of the outline's radius, its length over 2 pi,
    /// whichever is less; with the open boundaries inside the region, and with its handles, for
    /// which the ring is made narrower.
    std::optional<Region> feature = std::nullopt;
    double share = 0.5;
    /// Joins the outlines of a region that has several, such as one around a cup's handle
    /// (join_outlines).
    bool join_outlines = false;
};

/// Faces of the source: the region Omega_0 that was marked, the feature in it, and the ring between
/// them. Invariant: the ring is an annulus.
struct PasteRegions {
    std::vector<Index> region, feature, ring;
    /// Outlines of region and feature. Both run counter-clockwise around the feature.
    std::vector<Index> outer, inner;
    /// Strips of the surface beside the region join its outlines.
    bool joined = false;
};

/// Cleans the marked faces: of the region the part that holds most of the feature stays, both grow
/// at vertices that alone join their faces, islands in them are filled, and several parts of a
/// feature are joined by the faces between them, as are the outlines of the region if that is
/// wanted. The feature may have any genus, and open boundaries of its own. Errors, naming vertices:
/// topology_mismatch for regions of another mesh; region_empty if region or feature holds no face,
/// or the region has no outline; invalid_argument for a share out of range; boundary_conflict if
/// the feature touches the region's outline; not_a_disk if the ring has a handle or more than its
/// two boundaries; cancelled.
PasteRegions paste_regions(const Mesh& source, const PasteMarks& marks, const Context& context);

/// Returns the marked faces of a region, cleaned the same way, with islands in them: they may have
/// handles.
/// Errors: topology_mismatch; region_empty if there are none, or nothing around them; cancelled.
std::vector<Index> outlined_faces(const Mesh& mesh, const Region& region, const Context& context);

/// Returns the marked faces of the target, cleaned the same way. Errors: topology_mismatch;
/// region_empty; not_a_disk, naming vertices, if they have a hole or a handle; cancelled.
std::vector<Index> target_faces(const Mesh& target, const Region& onto, const Context& context);

/// Faces of the target within `radius` along edges of a point: the greatest disk of at most that
/// size. Errors: not_a_disk if there is none; cancelled.
std::vector<Index> disk_around(const Mesh& target, const SurfacePoint& point, double radius,
                               const Context& context);

}  // namespace lissom
