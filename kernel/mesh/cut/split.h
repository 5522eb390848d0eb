/// Splits a mesh exactly along contours; private to kernel/mesh.
#pragma once

#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/index.h"
#include "kernel/mesh/cut/contour.h"
#include "kernel/mesh/derive.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/query/path.h"

namespace lissom {

/// Lines and sides of a split.
struct Splitting {
    /// The contours to split along; no others are.
    std::vector<ContourLine> lines;
    /// For each vertex the part that it goes to: 1 the positive one, -1 the negative one. Edges
    /// join different parts only if a line crosses them.
    std::vector<signed char> side;
    /// Fraction of an edge within which its end slides onto a line.
    double slide = 0.25;
};

/// A part of the mesh that was split.
struct SplitPart {
    Mesh mesh;
    MeshMap map;
    /// The lines, in the order of Splitting::lines.
    std::vector<Path> lines;
};

struct SplitResult {
    /// Lines have the part's surface on their left. Those of the negative part start at the same
    /// point as the positive part's and run against them.
    SplitPart positive, negative;
    /// Old vertices that were moved onto a line, ascending.
    std::vector<Index> slid;
    /// Old faces that were divided.
    Index divided_faces = 0;
};

/// Old vertices and faces keep their order in each part; vertices on the lines follow, line by line
/// in the order of the lines.
SplitResult split(const Mesh& mesh, const Splitting& splitting, const Context& context);

}  // namespace lissom
