/// The thickness of a solid surface: vertices and the points opposite to them, through the inside;
/// private to kernel/deform.
#pragma once

#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/mesh/measure/triangulation.h"

namespace lissom {

/// A vertex and the point opposite to it, in local numbers of a patch.
struct ThicknessPair {
    Index vertex = kNoIndex;
    Triangle opposite{kNoIndex, kNoIndex, kNoIndex};
    /// Barycentric coordinates of the point.
    Vec3 weight = Vec3::Zero();
    /// From the point to the vertex, at rest.
    Vec3 across = Vec3::Zero();
    /// Area around the vertex.
    double area = 0.0;
};

struct Thickness {
    /// Ascending by vertex.
    std::vector<ThicknessPair> pairs;
    /// The share of the region's area at vertices with a pair: near 1 for a solid, 0 for a sheet.
    double coverage = 0.0;
};

/// Finds the pairs of the region's vertices at rest: a ray from each vertex against its normal ends
/// at the first surface that looks the other way. A vertex whose ray leaves the patch, or meets a
/// surface from outside, has none. Errors: memory_limit; cancelled.
Thickness find_thickness(const WorkingPatch& work, const Context& context);

}  // namespace lissom
