/// A deformation as plain data, with the numbers of its mesh: for files, and for hashes.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/deformer.h"
#include "kernel/deform/holds/bone_handles.h"
#include "kernel/deform/holds/poses.h"
#include "kernel/deform/mesh_point.h"
#include "kernel/deform/options.h"
#include "kernel/deform/pipeline.h"
#include "kernel/mesh/region.h"

namespace lissom {

struct ConstraintSet;
struct RestShape;

struct HandleDescription {
    /// Vertices of the mesh, in the handle's own order, and points between them.
    std::vector<Index> vertices;
    std::vector<MeshPoint> points;
    HandleOptions options;
    /// The handle that is its mirror image, and the plane between them.
    std::optional<HandleId> partner;
    MirrorPlane mirror;
    HandlePose pose;
};

/// Handles and constraints with their poses.
struct DeformDescription {
    /// By HandleId; empty for a removed one.
    std::vector<std::optional<HandleDescription>> handles;
    std::vector<PointConstraint> constraints;
    std::vector<Bones> bones;
    /// Stiffness of each vertex of the region, in its order; empty if all are 1.
    std::vector<double> stiffness;
    /// Share of the volume that is kept, if it is not that of the options.
    std::optional<double> volume;
};

DeformDescription describe(const DeformSnapshot& snapshot);

/// Returns the snapshot of this description on a rest shape, which it shows: but for that to the
/// bit the one described if the rest shape is the same. Errors: those of Deformer's add_handle,
/// set_transform and constrain; invalid_argument for partners that are not each other's, a
/// stiffness that has not one factor a vertex of the region, or bones that share a handle or whose
/// numbers do not fit.
DeformSnapshot snapshot_of(const DeformDescription& description,
                           std::shared_ptr<const RestShape> rest);

/// Returns the rest shape of a deformer.
std::shared_ptr<const RestShape> rest_of(const Deformer& deformer);

/// The region of a rest shape, its options, and the positions of the region's vertices.
const Region& region_of(const RestShape& rest);
const DeformOptions& options_of(const RestShape& rest);
const std::vector<Vec3>& positions_of(const RestShape& rest);

/// Returns the bytes of a rest shape, a constraint set or a result, about.
std::size_t memory_bytes(const RestShape& rest);
std::size_t memory_bytes(const ConstraintSet& constraints);
/// Returns the bytes of the present handles and constraints, which are on no account.
std::size_t constraint_bytes(const Deformer& deformer);
std::size_t memory_bytes(const DeformFrame& frame);

}  // namespace lissom
