/// A target with the features removed at a part's place (thesis section 3.4.1); private to
/// kernel/merge.
#pragma once

#include <optional>
#include <span>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/paste/paste_options.h"
#include "kernel/merge/paste/placement/paste_map.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/region.h"

namespace lissom {

struct ClearedTarget {
    Mesh mesh;
    /// From its elements to those of the target as given.
    MeshMap map;
    /// The region for parts, with the patch in place of the removed part.
    std::optional<Region> onto;
    /// The vertices of the removed faces of the target as given.
    Region gone;
    PasteClearing found;
    /// Turn of the patch from face to face, over the greater of 30 degrees and that of the surface
    /// around it.
    double unevenness = 0.0;
};

/// Returns an upper bound of a part's place: the connected vertices within `radius` of a point of
/// the surface, in a straight line. Errors: cancelled.
Region region_under(const Mesh& target, const SurfacePoint& point, double radius,
                    const Context& context);

/// Returns the vertices under the boundary of a part: those connected with `face` whose nearest
/// point on the surface `base`, which is the target without its features, lies inside the line, of
/// the plane of `base`. Errors: cancelled.
Region region_under_line(const Mesh& target, Index face, const PasteMap& base,
                         std::span<const Vec2> line, const Context& context);

/// Removes a region with its ring. Errors: as erase_feature.
ClearedTarget cleared_target(const Mesh& target, const std::optional<Region>& onto,
                             const Region& gone, const Context& context);
/// Removes the features within `radius` of a point in a straight line, with a ring and with the
/// hollows between them. Returns nothing if the surface does not go on there. Errors: cancelled;
/// memory_limit.
std::optional<ClearedTarget> cleared_around(const Mesh& target, const std::optional<Region>& onto,
                                            const SurfacePoint& point, double radius,
                                            const Context& context);
/// Removes the features in a region and nothing beyond it. Returns nothing if it is a face wide.
/// Errors: as erase_feature.
std::optional<ClearedTarget> cleared_inside(const Mesh& target, const std::optional<Region>& onto,
                                            const Region& under, const Context& context);

}  // namespace lissom
