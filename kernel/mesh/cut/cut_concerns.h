/// Warnings about the lines of a cut; private to kernel/mesh.
#pragma once

#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/mesh/cut/contour.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/cut/cut_parts.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Adds to the report which open boundaries the lines end at and which lines are folded.
void add_concerns(const Mesh& mesh, const std::vector<ContourLine>& lines, CutReport& report);

/// Adds which part of the mesh's area is kept, and whether that is suspiciously much.
void add_kept_fraction(const Mesh& mesh, const std::vector<ContourLine>& lines,
                       const CutSides& sides, CutReport& report);

/// Adds the numbers of outlines and pieces of a region's cut, if there are several outlines.
void add_outlines(const Mesh& mesh, const std::vector<ContourLine>& lines, const CutSides& sides,
                  CutReport& report);

/// Area of a closed polyline as a fraction of that of its convex outline, both seen along the
/// polyline's mean normal: 1 for a convex one, less for one with deep folds. 0 if it has no area.
double fullness(const std::vector<Vec3>& points);

}  // namespace lissom
