/// The rest shape of a deformation; private to kernel/deform.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/core/memory_hold.h"
#include "kernel/deform/holds/constraint_set.h"
#include "kernel/deform/holds/poses.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/lazy.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/deform/patch/sparse_row.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/deform/pipeline.h"
#include "kernel/deform/rotation/rest_directions.h"
#include "kernel/deform/volume/thickness.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// Scope and options of a deformation. All rest shapes of a Deformer share it.
struct DeformScope {
    Region region;
    DeformOptions options;
};

struct RestShape {
    std::shared_ptr<const DeformScope> scope;
    /// The region as the mesh has it.
    std::shared_ptr<const WorkingPatch> work;
    /// Row in the region of each local vertex of `work`, or kNoIndex.
    std::vector<Index> region_row;
    /// Positions of the region's vertices.
    std::vector<Vec3> positions;
    /// Greatest distance of a vertex of the region from the origin of the patch.
    double size = 0.0;
    /// Whether coordinates of the mesh have fewer digits for its shape than those of the patch.
    bool far_away = false;
    RestDirections directions;
    /// Vertices around the region and their positions.
    std::vector<std::pair<Index, Vec3>> surroundings;
    /// Positions of all vertices of the mesh, for refinements of a part of it; else empty.
    std::vector<Vec3> beyond = {};
    /// Found for the first preparation that keeps the volume.
    std::shared_ptr<const Lazy<Thickness>> thickness = std::make_shared<const Lazy<Thickness>>();
    /// Memory of all parts.
    MemoryHold hold = {};

    const Region& region() const { return scope->region; }
    const DeformOptions& options() const { return scope->options; }
    const Patch& patch() const { return work->patch; }
    const Vec3& origin() const { return work->patch.origin; }
    /// Returns the local number of a vertex of the region or next to it.
    Index local_vertex(Index mesh_vertex) const;
    /// Relative to the origin of the patch.
    Vec3 position_of(const SparseRow& row) const;
    Vec3 center_of(const Handle& handle) const;
    /// Returns the row of local vertex v in a frame's positions on `of`, a refinement of the patch.
    Index frame_row(const Patch& of, Index v) const;
};

/// Errors: topology_mismatch, naming vertices around the region that have moved.
void require_surroundings(const RestShape& rest, const Mesh& mesh);

/// Writes the rest shape, as write_frame does.
void write_rest(const RestShape& rest, Mesh& mesh);

/// The pose that takes p to about + transform(p - about), without a turn. Both forms of the
/// transform come from differences in extended precision, so that a rotation about a point far from
/// the origin keeps its digits.
HandlePose placed(const RestShape& rest, const Affine& transform, const Vec3& about);

/// The pose of the mirror image of a handle that stands in `pose`.
HandlePose reflected(const RestShape& rest, const MirrorPlane& plane, const HandlePose& pose);

/// Errors: handle_removed.
const Handle& handle_of(const ConstraintSet& constraints, HandleId id);

/// Errors: invalid_argument if `poses` are not those of `holds`.
void require_poses(const ConstraintSet& constraints, const Poses& poses);

/// Errors: invalid_argument if `frame` is none of this rest shape.
void require_frame(const RestShape& rest, const DeformFrame& frame);

/// Moves a handle, as pose_handle of pipeline.h; `turn` is near the one to take.
void pose_handle(const RestShape& rest, const ConstraintSet& constraints, Poses& poses, HandleId id,
                 const Affine& transform, const Vec3& about, const Vec3& turn);

/// Returns true if no pose differs from rest.
bool at_rest(const RestShape& rest, const ConstraintSet& constraints, const Poses& poses);

}  // namespace lissom
