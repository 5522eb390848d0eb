/// Triangles of least area over a closed line in space.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {

/// Whether an edge between two points of the line, by their places in it, must not be used, for
/// instance because a surface around the line has it. Not asked for edges of the line.
using ChordTaken = std::function<bool(Index, Index)>;

/// Triangulates a closed line without further points: the triangles with the least total area, and
/// with nearly equal areas, as in a plane, the better shape. They name points by their places in
/// `loop` and turn as it runs. Up to 300 points by dynamic programming over all chords (Barequet
/// and Sharir 1995), in cubic time; a longer line over the chords near those of the line with every
/// second point, in linear time: usually within 1 % of the least area. Empty if the chords that are
/// left give no triangulation. Errors: invalid_argument for fewer than 3 points; cancelled.
std::vector<Triangle> minimum_area_triangles(std::span<const Vec3> loop,
                                             const ChordTaken& taken = {},
                                             const Context& context = {});

}  // namespace lissom
