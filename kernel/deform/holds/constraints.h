/// What holds the vertices of a patch: the handles, the constraints of vertices and points, and the
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
/// Of parts that nothing holds: they stay, or follow what is near once that is solved.
inline constexpr Index kLoose = -4;

/// What is asked of local vertices and anchors, by their number.
using VertexConstraints = std::map<Index, VertexConstraint>;

/// True where a preparation cannot work on the rest patch as it is; `transition` is that of the
/// options.
bool changes_patch(const ConstraintSet& constraints, double transition);

/// Who holds which local vertices of a patch, and what that makes known.
struct Holding {
    std::vector<Index> owner;
    KnownMask known;
    /// Anchors and vertices that take what a target asks that is no hard vertex, with its number.
    std::vector<std::pair<Index, Index>> asked;
};

/// The patch with the stiffness asked for, and an anchor for every point and every vertex that is
/// held softly.
/// Errors: handle_overlap where a point leaves nothing to move, naming its vertices.
std::shared_ptr<const WorkingPatch> anchored(const WorkingPatch& rest,
                                             const ConstraintSet& constraints, double transition);

/// Outside the region, and without faces, vertices are pinned. A hard point that asks for a
/// gradient gives it to the vertices around it that nobody else holds.
Holding find_holding(const WorkingPatch& work, const ConstraintSet& constraints);

/// Local vertices, ascending, of each connected part that nothing holds at all.
std::vector<std::vector<Index>> loose_parts(const WorkingPatch& work, const KnownMask& known);

/// Throws `unconstrained` where a connected part with free vertices has no known position, or
/// neither a known gradient nor four known positions that are not in one plane.
void require_constraints(const WorkingPatch& work, const KnownMask& known);

}  // namespace lissom
