/// Common steps of all cuts once their lines are known; private to kernel/mesh.
#pragma once

#include <functional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/mesh/cut/contour.h"
#include "kernel/mesh/cut/cut.h"
#include "kernel/mesh/mesh.h"

namespace lissom {

/// Errors: mesh_empty; invalid_argument.
void require_cuttable(const Mesh& mesh, const CutOptions& options);

/// Returns the side of the lines that each vertex is on: 1 or -1, and 0 in components without a
/// line. Errors: boundary_conflict if the sides are connected.
std::vector<signed char> sides_of(const Mesh& mesh, const std::vector<ContourLine>& lines);

/// Gives components that no line crosses the side that `side_of` names for their vertices, and
/// returns how many there are.
using SideOfComponent = std::function<signed char(const std::vector<Index>& vertices)>;
Index assign_whole_components(const Mesh& mesh, std::vector<signed char>& side,
                              const SideOfComponent& side_of);

/// Returns the side of the nearest vertex to `seed` that has one.
signed char side_near(const Mesh& mesh, const std::vector<signed char>& side, const Vec3& seed);

/// Lines of a cut.
struct CutLines {
    /// Lines to cut along, and the remaining ones of the plane.
    std::vector<ContourLine> lines, others;
    CutReport report;
};

/// Sides of the lines.
struct CutSides {
    /// Side of every vertex: 1 or -1.
    std::vector<signed char> side;
    /// The side that is kept.
    signed char kept = 1;
    /// The kept part was named by a seed or vertex by vertex, not by a direction alone.
    bool named = false;
    /// The lines are all outlines of a region.
    bool outlined = false;
    Index whole_components = 0;
};

/// Divides the mesh.
Cut cut_along(const Mesh& mesh, CutLines found, CutSides sides, const CutOptions& options,
              const Context& context);

/// Returns the preview of `cut_along` with the sides that `decide` returns.
CutPreview preview_along(const Mesh& mesh, const CutLines& found,
                         const std::function<CutSides()>& decide);

}  // namespace lissom
