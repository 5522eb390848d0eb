/// The target of a paste, opened where the part goes; private to kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/paste/placement/paste_map.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

struct OpenedTarget {
    Mesh mesh;
    /// From its elements to those of the target as given.
    MeshMap map;
    /// The new boundary, in the direction of the surface: clockwise around the hole.
    std::vector<Index> loop;
};

/// Cuts out of the target what lies inside a loop that is given in the plane of its chart,
/// counter-clockwise. The boundary runs near the loop, on the surface: it is the line along which
/// the distance to the loop, linear on triangles, is 0, so that there are no slivers and no teeth.
/// Errors: boundary_conflict where no vertex of the target, or all of its region, lies inside, or
/// where the loop crosses itself; as `cut`; cancelled.
OpenedTarget open_target(const Mesh& target, const PasteChart& chart, std::span<const Vec2> loop,
                         const Context& context);

}  // namespace lissom
