/// Changes of who is held: steps from holds and poses to others; private to kernel/deform.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "kernel/core/index.h"
#include "kernel/deform/holds/bone_handles.h"
#include "kernel/deform/holds/constraint_set.h"
#include "kernel/deform/holds/mirror_surface.h"
#include "kernel/deform/holds/poses.h"
#include "kernel/deform/mesh_point.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/sparse_row.h"
#include "kernel/deform/rest_shape.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Constraints and poses under construction. After an error they are not to be used: work on
/// copies, and keep them when all is done.
struct ConstraintEdit {
    const RestShape& rest;
    ConstraintSet& constraints;
    Poses& poses;

    // Errors of these are those of the functions of Deformer of the same names.
    HandleId add_handle(const Region& vertices, const HandleOptions& options);
    HandleId add_handle(std::span<const MeshPoint> points, const HandleOptions& options);
    HandleId mirror_handle(HandleId id, const MirrorPlane& plane);
    void set_handle_region(HandleId id, const Region& vertices);
    /// Bones of the handle go too: its handles stay, and are no chain any more.
    void remove_handle(HandleId id);
    /// Errors: invalid_argument for numbers of joints, limits and handles that do not fit, bones
    /// without length and handles of other bones; not_finite; handle_removed.
    void add_bones(Bones bones);
    void set_stiffness(const Region& vertices, double factor);
    /// Replaces the target of a point by `asked`, which may be empty.
    void set_target(Target target, const TargetPose& pose);

  private:
    HandleId add(Handle handle, const HandlePose& pose);
    Handle mirror_image(Index number, const Handle& handle, const MirrorPlane& plane) const;
    std::vector<Index> mirrored_vertices(const MirrorSurface& surface, const Handle& handle) const;
    SparseRow mirrored_point(const MirrorSurface& surface, const SparseRow& row,
                             const MirrorPlane& plane) const;
    void part_from_image(const Handle& handle, Handle& image) const;
    void yield_to_others(const Handle& handle, Index number, Handle& image) const;
    void require_handle_region(const Region& vertices, std::span<const Index> except = {}) const;
};

/// The target of a constraint, which is checked. Errors: as Deformer::constrain.
Target checked_target(const RestShape& rest, const ConstraintSet& constraints,
                      const PointConstraint& given);

/// Place of the target of the same point, if any, or its place of insertion.
struct TargetPlace {
    std::size_t at = 0;
    bool found = false;
};
TargetPlace find_target(const ConstraintSet& constraints, const Target& target);

/// Returns the poses of everything at rest: handles and targets keep their present places.
Poses resting_poses(const RestShape& rest, const ConstraintSet& constraints);

/// `constraints` for another rest shape of the same region, to which `poses` led: joints of bones
/// lie where these carry them.
ConstraintSet moved_to(const RestShape& rest, const ConstraintSet& constraints, const Poses& poses);

}  // namespace lissom
