/// What holds the vertices of a patch: the handles, the constraints of vertices and points, and the
/// rest of the mesh; private to kernel/deform.
#pragma once

#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "kernel/deform/holds/known_mask.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/deform/patch/working_patch.h"

namespace lissom {

/// Owners of local vertices other than handles, which count from 0.
inline constexpr Index kFree = -1;
inline constexpr Index kPinned = -2;
inline constexpr Index kConstrained = -3;

/// One handle of a deformer; removed handles leave their place empty.
struct HandleState {
    Region region;
    HandleOptions options;
    Affine transform = {};
    Vec3 center = Vec3::Zero();
    /// Its local vertices, and its points as means of local vertices.
    std::vector<Index> local = {};
    std::vector<SparseRow> points = {};
    bool removed = false;
    /// `transform` as the patch sees it: relative to the patch's origin, with digits that the one
    /// above lacks where the mesh lies far from the origin of its coordinates.
    Affine in_patch{};
    /// The rotation of the transform as a rotation vector that counts full turns.
    Vec3 turn = Vec3::Zero();
    /// The handle that is its mirror image, or kNoIndex.
    Index partner = kNoIndex;
    MirrorPlane mirror = {};

    bool at_rest() const { return transform.is_identity() && turn.isZero(0.0); }
    void set_at_rest() {
        transform = in_patch = {};
        turn.setZero();
    }
    bool soft() const { return options.weight.has_value(); }
};

/// Hard constraints of single vertices by local vertex.
using VertexConstraints = std::map<Index, VertexConstraint>;

/// A soft constraint, or one of a point that is not a vertex, with its point as a mean of local
/// vertices.
struct PointState {
    PointConstraint asked;
    SparseRow row;
};

/// All that holds.
struct Holds {
    const std::vector<HandleState>& handles;
    const VertexConstraints& constraints;
    const std::vector<PointState>& points;
    /// Stiffness of each real local vertex, or empty where all are 1.
    const std::vector<double>& stiffness;
    /// DeformOptions::transition.
    double transition = 0.0;

    /// True where a preparation cannot work on the rest patch as it is.
    bool change_patch() const;
};

/// Who holds which local vertices of a patch, and what that makes known.
struct Holding {
    std::vector<Index> owner;
    KnownMask known;
    /// Anchors and vertices that take what a point constraint asks, with its number.
    std::vector<std::pair<Index, Index>> asked;
};

/// The patch with the stiffness asked for, and an anchor for every point and every vertex that is
/// held softly.
/// Errors: handle_overlap where a point leaves nothing to move, naming its vertices.
std::shared_ptr<const WorkingPatch> anchored(const WorkingPatch& rest, const Holds& holds);

/// Outside the region, and without faces, vertices are pinned. A hard point that asks for a
/// gradient gives it to the vertices around it that nobody else holds.
Holding find_holding(const WorkingPatch& work, const Holds& holds);

/// Throws `unconstrained` where a connected part with free vertices has no known position, or
/// neither a known gradient nor four known positions that are not in one plane.
void require_constraints(const WorkingPatch& work, const KnownMask& known);

}  // namespace lissom
