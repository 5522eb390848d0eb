/// Factors and operators that depend on the held vertices alone; private to kernel/deform.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/error.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/core/memory_hold.h"
#include "kernel/deform/comparison_method.h"
#include "kernel/deform/holds/constraint_set.h"
#include "kernel/deform/holds/constraints.h"
#include "kernel/deform/holds/handle_gaps.h"
#include "kernel/deform/holds/known_mask.h"
#include "kernel/deform/holds/loose_parts.h"
#include "kernel/deform/levels/level_method.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/lazy.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/deform/patch/working_patch.h"
#include "kernel/deform/rest_shape.h"
#include "kernel/deform/stats.h"
#include "kernel/deform/system/frame_loops.h"
#include "kernel/deform/system/gradient_system.h"
#include "kernel/deform/system/gradients.h"
#include "kernel/deform/system/linear_solution.h"
#include "kernel/deform/system/rotation_system.h"
#include "kernel/deform/volume/volume_springs.h"

namespace lissom {

/// Responses of the second system to translations of handles: the response to each handle of the
/// solution, empty for one unknown to the second system; and the force on movable handle j that
/// handle k makes.
struct HandleResponses {
    std::vector<RotationSystem::Response> of_handles;
    Eigen::MatrixXd stiffness;
    /// The movable handles, in the order of its rows.
    std::vector<Index> movable;
};

/// The method of the thesis: both systems, and the basis of the first.
struct ImplicitMethod {
    GradientStencils gradients;
    std::unique_ptr<GradientSystem> first;
    std::unique_ptr<RotationSystem> second;
    /// Null if nothing is free.
    std::unique_ptr<LinearSolution> solution;
    /// Row among the positions of a frame of each row of the solution, or kNoIndex for virtual
    /// vertices.
    std::vector<Index> frame_row;
    /// Vertices of the region and of a refinement without a known gradient: those with a stencil,
    /// and those without, which take the mean of their neighbours.
    std::vector<Index> gathered, averaged;
    Lazy<HandleResponses> answers;
    /// Gradients of the weights of translations, of each handle of the solution at each of
    /// `gathered`; only for few handles that turn far.
    Lazy<std::vector<std::vector<Vec3>>> weight_gradients;
    /// Only for poses that keep the volume.
    Lazy<VolumeSprings> springs;
};

/// Vertices whose gradient is prescribed together: those of a handle, one with a constraint, or all
/// that are pinned.
struct GradientSource {
    Index owner = kPinned;
    Index vertex = kNoIndex;
};

/// A method that the thesis compares with; the source of each local vertex's gradient, or kNoIndex,
/// and the sources.
struct ComparedMethod {
    std::unique_ptr<ComparisonMethod> method;
    std::vector<Index> source;
    std::vector<GradientSource> sources;
};

struct Preparation {
    std::shared_ptr<const RestShape> rest;
    std::shared_ptr<const ConstraintSet> constraints;
    /// Memory beside the factors, and that of a frame.
    MemoryHold hold;
    /// The patch that it works on: refined at borders, with anchors.
    std::shared_ptr<const WorkingPatch> work;
    std::vector<Index> owner;
    /// The local vertices of each handle, with those that a refinement inserted between them.
    std::vector<std::vector<Index>> held;
    KnownMask known;
    /// Parts that follow the surface near them, once it is solved.
    std::vector<FollowingPart> following;
    /// Gaps between handles that nearly touch.
    std::vector<HandleGap> gaps;
    /// Local vertices and anchors that take the values of a target, with its number.
    std::vector<std::pair<Index, Index>> asked;
    /// Rows of the region whose vertices stay at rest, as nothing that moves holds them.
    std::vector<Index> resting_rows;
    std::variant<ImplicitMethod, ComparedMethod, LevelMethod> method;
    /// Costs of this preparation alone.
    DeformStats costs;

    const Patch& patch() const { return work->patch; }
    const Rings& rings() const { return work->rings; }
    /// Null for a comparison method, and on two levels.
    const ImplicitMethod* implicit() const { return std::get_if<ImplicitMethod>(&method); }
    /// Null on one level.
    const LevelMethod* levels() const { return std::get_if<LevelMethod>(&method); }
    LinearProblem problem() const;
    GradientLoop gradient_loop() const;
};

/// Returns prepare_deformation of the other arguments, sooner if `former` is a preparation of the
/// same region that nobody else holds: parts in common with the new one are taken from it. It is
/// null afterwards, unless an error names a fault of the constraints.
std::shared_ptr<const Preparation> prepare_next(
    std::shared_ptr<const Preparation>& former, const std::shared_ptr<const RestShape>& rest,
    const std::shared_ptr<const ConstraintSet>& constraints, const Context& context);

/// Translates a solver's error from rows, which stand for the vertices `free`, to vertices: throws
/// unconstrained.
[[noreturn]] void refuse_singular(const Patch& patch, const Error& error,
                                  const std::vector<Index>& free);

/// Throws `unsupported`, with `what` as subject, unless the method is the implicit one.
void require_implicit(const DeformOptions& options, const char* what);

/// The same, and throws too if the options ask for levels.
void require_whole_surface(const DeformOptions& options, const char* what);

/// Throws `unsupported` if the options name a comparison method without its maker.
void require_comparison(const DeformOptions& options);

/// Factors the comparison method that the options name. Errors: unsupported; as
/// prepare_deformation.
void prepare_comparison(Preparation& next, const Context& context);

/// Whether DeformOptions::level_vertices has an effect on a region of this size.
bool wants_levels(const DeformOptions& options, Index region_vertices);

/// Returns the constraints and options that need the whole surface, or an empty text.
std::string refused_levels(const DeformOptions& options, const ConstraintSet& constraints);

/// Thins out the patch and factors that surface. Returns nothing if it cannot be prepared, as of a
/// patch that is no manifold; then the whole surface tells why. Errors: cancelled; memory_limit.
std::optional<LevelMethod> prepare_levels(const Preparation& next, const Context& context);

/// Checks `holds` against the options: unsupported if a comparison method cannot hold them.
void require_plain_holds(const ConstraintSet& constraints, const DeformOptions& options);

}  // namespace lissom
