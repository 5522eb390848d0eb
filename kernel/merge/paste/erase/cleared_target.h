/// A target whose features have been removed where a part goes (thesis section 3.4.1); private to
/// kernel/merge.
#pragma once

#include <optional>

#include "kernel/core/context.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/spatial_tree.h"
#include "kernel/mesh/region.h"

namespace lissom {

struct ClearedTarget {
    Mesh mesh;
    /// From its elements to those of the target as given.
    MeshMap map;
    /// The region for parts, with the patch in place of what was removed from it.
    std::optional<Region> onto;
};

/// What lies under a part: the vertices within `radius` of a point of the surface, in a straight
/// line, that hang together with it. Errors: cancelled.
Region region_under(const Mesh& target, const SurfacePoint& point, double radius,
                    const Context& context);

/// Errors: as erase_feature.
ClearedTarget cleared_target(const Mesh& target, const std::optional<Region>& onto,
                             const Region& gone, const Context& context);

}  // namespace lissom
