/// Input of one frame: a preparation and poses; private to kernel/deform.
#pragma once

#include <utility>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/holds/constraints.h"
#include "kernel/deform/holds/poses.h"
#include "kernel/deform/options.h"
#include "kernel/deform/patch/patch.h"
#include "kernel/deform/preparation.h"
#include "kernel/deform/system/linear_solution.h"

namespace lissom {

/// Values of targets at local vertices and anchors, and their part of the free vertices.
struct TargetRhs {
    VertexConstraints at;
    FixedPart fixed;
};

/// Costs a solve with the first system if there are targets.
TargetRhs target_rhs(const Preparation& prepared, const std::vector<TargetPose>& targets);

/// Positions are relative to the patch's origin. All that it is made from lives as long.
class FrameInput {
  public:
    /// `room` may be memory of a former one: see take_room.
    FrameInput(const Preparation& prepared, const Poses& poses, const TargetRhs& asked,
               std::vector<Mat4> room = {});

    /// Returns its memory, for the next one; this one is of no more use.
    std::vector<Mat4> take_room() { return std::move(differences_); }

    const Preparation& prepared() const { return prepared_; }
    const ImplicitMethod& method() const { return *prepared_.implicit(); }
    const LinearSolution& solution() const { return *method().solution; }
    const DeformOptions& options() const { return prepared_.rest->options(); }
    bool scales() const { return options().local_size == LocalSize::scale; }
    const Patch& patch() const { return prepared_.patch(); }
    const Poses& poses() const { return poses_; }
    const HandlePose& pose(Index handle) const { return poses_.handles[at(handle)]; }
    const TargetRhs& asked() const { return asked_; }

    /// The transform that deviations are relative to: of the solution's base, or the identity.
    const Mat4& base() const { return base_; }
    Mat3 base_linear() const { return base_.topLeftCorner<3, 3>(); }
    /// Transforms of the solution's handles less that of the base.
    const std::vector<Mat4>& differences() const { return differences_; }

    Vec3 known_position(Index v) const;
    /// Exactly zero for a handle that moves as the base does.
    Vec3 known_deviation(Index v) const;
    Mat3 known_gradient(Index v) const;

    /// Turns and logarithms of scale of the solution's handles, relative to the base.
    void find_relative_turns(std::vector<Vec4>& turns) const;
    /// The greatest turn between two handles; `turns` is memory for it. The thesis's literal
    /// formulation knows no turns.
    double max_turn(std::vector<Vec4>& turns) const;
    /// Makes `field` the sum over h of w_h value_h at every local vertex; w_h are the weights of
    /// translations in the first system.
    void spread(const std::vector<Vec4>& value, std::vector<Vec4>& field,
                const Context& context) const;
    /// Adds the moves of targets to `field`, relative to a base at rest.
    void add_asked_moves(std::vector<Vec4>& field) const;

  private:
    void add_relative_turns(std::vector<Vec4>& turns) const;

    const Preparation& prepared_;
    const Poses& poses_;
    const TargetRhs& asked_;
    Mat4 base_;
    std::vector<Mat4> differences_;
};

}  // namespace lissom
