/// Constraints of the vertices of a patch: the handles, constrained vertices and points, and the
/// rest of the mesh; private to kernel/deform.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/deform/holds/constraint_set.h"
#include "kernel/deform/holds/known_mask.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/working_patch.h"

namespace lissom {

/// Owners of local vertices other than handles, which count from 0.
inline constexpr Index kFree = -1;
inline constexpr Index kPinned = -2;
inline constexpr Index kConstrained = -3;
/// Owner of unconstrained parts: they stay, or follow the surface near them once it is solved.
inline constexpr Index kLoose = -4;

/// Constraints of local vertices and anchors, by their number.
using VertexConstraints = std::map<Index, VertexConstraint>;

/// Returns if a preparation needs a patch other than the rest patch; `transition` is that of the
/// options.
bool changes_patch(const ConstraintSet& constraints, double transition);

/// Owners of the local vertices of a patch, and the known values that follow.
struct HolderMap {
    std::vector<Index> owner;
    KnownMask known;
    /// Anchors and vertices with the value of a target that is no hard vertex, and its number.
    std::vector<std::pair<Index, Index>> asked;
};

/// Returns the patch with the given stiffness, and an anchor for every point and every softly held
/// vertex.
/// Errors: handle_overlap if all vertices of a point are held already, naming them.
std::shared_ptr<const WorkingPatch> anchored(const WorkingPatch& rest,
                                             const ConstraintSet& constraints, double transition);

/// Outside the region, and without faces, vertices are pinned. A hard point that asks for a
/// gradient gives it to the vertices around it that nobody else holds.
HolderMap find_holding(const WorkingPatch& work, const ConstraintSet& constraints);

/// Local vertices, ascending, of each connected part that nothing holds at all.
std::vector<std::vector<Index>> loose_parts(const WorkingPatch& work, const KnownMask& known);

/// Throws `unconstrained` if a connected part with free vertices has no known position, or neither
/// a known gradient nor four known positions that are not in one plane.
void require_constraints(const WorkingPatch& work, const KnownMask& known);

}  // namespace lissom
