/// The target of a paste, opened at the part's place; private to kernel/merge.
#pragma once

#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/merge/piece/places.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

struct OpenedTarget {
    Mesh mesh;
    /// From its elements to those of the target as given.
    MeshMap map;
    /// Among those; vertices made on the line have none and come last.
    Places place;
    /// The new boundary, in the direction of the surface: clockwise around the hole.
    std::vector<Index> loop;
};

/// Cuts out of the target the part inside a loop of the plane, counter-clockwise, in which some of
/// its vertices lie at `uv`: those of its chart. The boundary runs near the loop, on the surface:
/// it is the line along which the distance to the loop, linear on triangles, is 0, so that there
/// are no slivers and no teeth. Errors: boundary_conflict if no vertex or all of the target's
/// region lies inside, or if the loop crosses itself; as `cut`; cancelled.
OpenedTarget open_target(const Mesh& target, std::span<const Index> vertices,
                         std::span<const Vec2> uv, std::span<const Vec2> loop,
                         const Context& context);

}  // namespace lissom
