/// The band of triangles between two closed polylines; private to kernel/merge.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"

namespace lissom {

/// A triangle of a band: an edge of one of the two loops and a vertex of the other. The edge runs
/// from point `edge` to the next of the first loop (`of_first`) or of the second.
struct BandTriangle {
    bool of_first = true;
    Index edge = 0, apex = 0;
};

/// The band of least area between two closed polylines that run the same way: n + m triangles
/// (Fuchs, Kedem and Uselton 1977, by divide and conquer over the start). The triangles follow each
/// other around the band. Time n m log n.
std::vector<BandTriangle> min_area_band(std::span<const Vec3> first, std::span<const Vec3> second,
                                        const Context& context = {});

}  // namespace lissom
