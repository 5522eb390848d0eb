/// Deformation as a pipeline of values, for hosts that need more than one Deformer gives: several
/// frames at the same time, or an undo.
///
///     RestShape, ConstraintSet -> Preparation
///     Preparation, Poses -> DeformFrame
///     DeformFrame -> positions of a mesh, or the next RestShape
///
/// Rest shape, constraint set and preparation do not change once they are made, and a step reads
/// nothing but its arguments. A Deformer keeps one value of each kind; two threads may pose two
/// copies:
///
///     const auto prepared = deformer.prepare();
///     Poses left = deformer.snapshot().poses, right = left;
///     pose_handle(*prepared, left, tip, turned, center);
///     pose_handle(*prepared, right, tip, lifted, center);
///     // each on a thread of its own, with scratch of its own:
///     const DeformFrame a = solve_frame(prepared, left, scratch_a);
///     const DeformFrame b = solve_frame(prepared, right, scratch_b);
///     write_frame(*rest_of(*prepared), a, mesh);
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/deform/holds/poses.h"
#include "kernel/deform/options.h"
#include "kernel/mesh/mesh.h"
#include "kernel/mesh/region.h"

namespace lissom {

/// The region at rest with the options, and all that follows from them; immutable.
struct RestShape;
/// Handles and constraints without their poses; immutable.
struct ConstraintSet;
/// The factored systems of a constraint set, for all of its poses; immutable.
struct Preparation;
/// A patch with its operators; private to kernel/deform.
struct WorkingPatch;

/// One result. Assigning it keeps it: nothing that is solved later changes it.
struct DeformFrame {
    /// Its preparation, kept while gradients may be asked for, and the poses.
    std::shared_ptr<const Preparation> preparation;
    Poses poses;
    /// Positions of the region's vertices, in the region's order.
    std::vector<Vec3> positions;
    /// Vertices that a refinement of coarse borders inserted, and the patch that they belong to;
    /// null at rest.
    std::vector<Vec3> inserted;
    std::shared_ptr<const WorkingPatch> patch;
    /// Rotations of the region's vertices without faces.
    std::vector<Mat3> turns_without_faces;
    /// Deformation gradients, if they are known already; see frame_gradients.
    std::optional<std::vector<Mat3>> gradients;
};

/// Buffers of frames in the making, with values that they find once and use again; one for each
/// thread. It changes no result.
class FrameScratch {
  public:
    FrameScratch();
    ~FrameScratch();
    FrameScratch(FrameScratch&&) noexcept;
    FrameScratch& operator=(FrameScratch&&) noexcept;
    /// Memory of a frame that is needed no more serves the next one.
    void recycle(DeformFrame&& frame);

    struct State;
    State& state() { return *state_; }

  private:
    std::unique_ptr<State> state_;
};

/// Takes the present shape of `mesh` as rest shape. Errors: as Deformer; cancelled.
std::shared_ptr<const RestShape> make_rest_shape(const Mesh& mesh, const Region& region,
                                                 const DeformOptions& options = {},
                                                 const Context& context = {});

/// Assembles and factors the systems for `holds`.
/// Errors: as Deformer::prepare; invalid_argument if either is null.
std::shared_ptr<const Preparation> prepare_deformation(
    const std::shared_ptr<const RestShape>& rest,
    const std::shared_ptr<const ConstraintSet>& constraints, const Context& context = {});
const std::shared_ptr<const RestShape>& rest_of(const Preparation& preparation);
const std::shared_ptr<const ConstraintSet>& constraints_of(const Preparation& preparation);

/// Moves a handle in `poses` as Deformer::set_transform does; `turn`, if given, is its rotation
/// vector. A mirror image moves along. Errors: as there; handle_removed; invalid_argument for poses
/// of other holds; and then `poses` are as they were.
void pose_handle(const Preparation& preparation, Poses& poses, HandleId handle,
                 const Affine& transform, const Vec3& about = Vec3::Zero(),
                 const std::optional<Vec3>& turn = std::nullopt);

/// The rest shape as a result.
DeformFrame rest_frame(const RestShape& rest);
/// The first system alone, or both. Errors: as Deformer::solve; invalid_argument without a
/// preparation, or for poses that have not one entry for each handle and target of its holds.
DeformFrame preview_frame(const std::shared_ptr<const Preparation>& preparation, const Poses& poses,
                          FrameScratch& scratch, const Context& context = {});
DeformFrame solve_frame(const std::shared_ptr<const Preparation>& preparation, const Poses& poses,
                        FrameScratch& scratch, FrameQuality quality = FrameQuality::full,
                        const Context& context = {});
/// Returns Deformer::gradients of a frame. Errors: invalid_argument for a frame that no step made.
std::vector<Mat3> frame_gradients(const DeformFrame& frame, FrameScratch& scratch);

/// Writes a frame as Deformer::apply_to. Errors: also invalid_argument for another region's frame.
void write_frame(const RestShape& rest, const DeformFrame& frame, Mesh& mesh);
/// The rest shape that lies as the frame does; see Deformer::rebase.
std::shared_ptr<const RestShape> rebased(const RestShape& rest, const DeformFrame& frame);

}  // namespace lissom
