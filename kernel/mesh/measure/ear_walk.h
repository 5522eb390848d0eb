/// Ear clipping of polygons with many corners; private to the kernel.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/corner_set.h"
#include "kernel/mesh/measure/plane_points.h"

namespace lissom {

/// Memory of clip_ears_around, kept from one polygon to the next.
struct EarRoom {
    std::vector<Index> before, after;
    /// For each corner the one that lies in its ear, and its place in the list of all ears in which
    /// that one lies.
    std::vector<Index> blocker, previous_blocked, next_blocked;
    /// For each corner the first ear of its list.
    std::vector<Index> first_blocked;
    std::vector<Vec2> flat_points;
    /// Corners not looked at since their ear changed; corners in line with their neighbours, and
    /// convex ones.
    CornerSet open, in_line, convex;
    /// Corners that are not convex: no others can lie in an ear.
    PlanePoints obstacles;
};

/// Appends the n - 2 triangles of a polygon of n > 3 corners; `normal` is the unit normal of its
/// mean plane. Ears are clipped as they come, going around. A corner in whose ear another one lies
/// is looked at again once that one is gone. The time grows about as n log n; a limit on the steps
/// of a corner bounds it for outlines made to be slow, whose triangles may then overlap.
void clip_ears_around(std::span<const Vec3> points, const Vec3& normal,
                      std::vector<std::array<Index, 3>>& triangles, EarRoom& room);

}  // namespace lissom
