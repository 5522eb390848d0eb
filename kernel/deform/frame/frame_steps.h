/// The steps of a frame: each reads its arguments and gives a value, or writes the one it is given
/// last; private to kernel/deform.
///
///     FrameInput -> deviation (first system) -> rotations -> deviation (second system) ->
///     DeformFrame
///
/// A deviation is the positions of local vertices, degenerate ones displaced, relative to the
/// base's transform of their rest position. Rotations are S_i of the second system, or R_i s_i,
/// less that of the base; outside the region they stay zero, as then the base is the identity.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "kernel/core/context.h"
#include "kernel/core/geometry.h"
#include "kernel/core/index.h"
#include "kernel/deform/frame/frame_input.h"
#include "kernel/deform/frame/moving_surface.h"
#include "kernel/deform/holds/poses.h"
#include "kernel/deform/options.h"
#include "kernel/deform/pipeline.h"
#include "kernel/deform/preparation.h"
#include "kernel/deform/system/frame_loops.h"
#include "kernel/deform/system/rotation_system.h"
#include "kernel/deform/volume/volume_springs.h"

namespace lissom {

using Deviation = std::vector<Vec4>;
using Rotations = std::vector<PaddedMat3>;

/// The prescribed part of the last frame, valid while the targets stay.
struct TargetMemo {
    std::weak_ptr<const Preparation> preparation;
    std::vector<TargetPose> targets;
    TargetRhs part;
};

/// Poses of the draft in the scratch; a full frame of the same poses starts from it.
struct DraftMemo {
    /// Whether there is one.
    bool is_there = false;
    std::weak_ptr<const Preparation> preparation;
    Poses poses;

    bool is_of(const std::shared_ptr<const Preparation>& other, const Poses& at) const {
        return is_there && preparation.lock() == other && poses == at;
    }
};

/// Memory of SpreadMoves.
struct SpreadRoom {
    std::vector<Vec4> of_handles;
    /// The moves themselves, for handles too many for gradients of weights.
    std::vector<Vec4> field;
};

/// Memory of TurnPart.
struct TurnPartRoom {
    Deviation deviation;
    std::vector<Vec4> turns;
    std::vector<Mat4> differences;
    SpreadRoom remainder;
};

/// A sum of turns by weights.
struct TurnSum {
    Vec4 field = Vec4::Zero();
    double total = 0.0, remainder = 1.0;

    void add(double raw, const Vec4& of);
};

/// Memory of wind_rotations.
struct WindingRoom {
    std::vector<Vec4> turns;
    std::vector<TurnSum> silent;
    std::vector<Vec3> forces;
    Deviation tied;
    SpreadRoom mismatch;
};

/// The stretch that a vertex takes over from a handle which does not hold its gradient exactly.
struct TakenStretch {
    Index vertex = kNoIndex;
    Mat3 stretch = Mat3::Identity();
};

/// Memory of refinements.
struct RefineRoom {
    Deviation plain, between;
    std::vector<Vec4> absolute, turns, sizes;
    /// Positions of the region, and of all vertices: without refinement and with a share of it.
    std::vector<Vec3> of_region, plain_shape, shape;
};

/// Memory of keep_volume; the springs' is of `springs_of`.
struct VolumeRoom {
    VolumeSprings::Scratch springs;
    std::weak_ptr<const Preparation> springs_of;
    std::vector<Vec4> values, strain;
};

struct FrameScratch::State {
    TargetMemo asked;
    DraftMemo draft;
    /// Deviation of the whole motion.
    Deviation deviation;
    TurnPartRoom part;
    WindingRoom winding;
    std::vector<TakenStretch> taken;
    /// Rotations that those of `taken` replace.
    Rotations untaken;
    /// Sized, and zero outside the region, for `sized_for`.
    Rotations rotations;
    std::weak_ptr<const Preparation> sized_for;
    RefineRoom refine;
    VolumeRoom volume;
    /// For refinements, of the preparation `surface_of`.
    std::optional<MovingSurface> surface;
    std::weak_ptr<const Preparation> surface_of;
    /// Memory of the frame before.
    std::vector<Vec3> positions;
    Poses poses;
    std::vector<Mat4> differences;
    std::vector<Vec4> turns;
    RotationSystem::Scratch second;
    /// For the thinned surface of LevelMethod.
    std::unique_ptr<FrameScratch> coarse;
};

const TargetRhs& target_rhs(const std::shared_ptr<const Preparation>& preparation,
                            const std::vector<TargetPose>& targets, TargetMemo& memo);

/// Gradients of the translations of the solution's handles, spread as in the first system, together
/// with the moves of targets.
class SpreadMoves {
  public:
    /// Of the translations in `room`, which lives as long.
    SpreadMoves(const FrameInput& motion, SpreadRoom& room, const Context& context);

    /// m[i - begin] for the i-th of vertices, i in [begin, end): of gathered vertices, or of any if
    /// some are averaged.
    void gather(const Index* vertices, Mat3* m, Index begin, Index end) const;

  private:
    const FrameInput& motion_;
    const SpreadRoom& room_;
    const std::vector<std::vector<Vec3>>* weight_gradients_ = nullptr;
};

/// The first system at a fraction of the turns that are asked for.
struct TurnPart {
    double fraction = 1.0;
    std::span<const Vec4> deviation;
    /// The part of the handles' translations and of the targets that the turns leave.
    SpreadMoves remainder;
};

/// Start of the second system.
struct SecondInput {
    const FrameInput& motion;
    /// S of the base.
    Mat3 base_rotation;
    /// The greatest turn between handles.
    double max_turn;
    bool draft;
};

/// S of the second system for a deformation gradient: R, or R s.
Mat3 rotation_of(const FrameInput& motion, const Mat3& gradient);

/// S of a vertex that is held and whose gradient is `linear`: all of `linear`, stretch included,
/// for a second system that knows lengths. With less the held surface would keep asking for the
/// size it had, and free vertices beside it would pay. The same as rotation_of for rigid motions.
Mat3 held_transform(const FrameInput& motion, const Mat3& linear);

/// Finds the stretches of vertices that stretched handles draw softly, or hold by position alone:
/// as much of the handle's as the gradients of the first system have. None for rigid motions.
void find_taken_stretches(const FrameInput& motion, std::span<const Vec4> deviation,
                          std::vector<TakenStretch>& taken);

void solve_first(const FrameInput& motion, const Context& context, Deviation& deviation);

/// M_i after the first system, or extrapolated from its `part`; the mean of the ring if it does not
/// exist.
Mat3 gradient_of(const FrameInput& motion, std::span<const Vec4> deviation, Index v,
                 const TurnPart* part = nullptr);

/// Part of the turns that the first system solves, if not all; it stands in `room`.
std::optional<TurnPart> part_of_turns(const FrameInput& motion, double max_turn, TurnPartRoom& room,
                                      const Context& context);
/// Extrapolates gradients of `part` by the rest of the turns, and adds the remainders: of vertices
/// [begin, end).
void extrapolate_rotation(const FrameInput& motion, const TurnPart& part, const Index* vertices,
                          Mat3* gradient, Index begin, Index end);

/// The share of the field of turns in the rotations, 0 to 1.
double share_of_turns(double max_turn);
/// M_i that the first system leads to, of the vertices [begin, end) of those that are gathered.
void first_gradients(const FrameInput& motion, const TurnPart* part,
                     std::span<const Vec4> deviation, Mat3* m, Index begin, Index end);
/// S_i of the same.
void first_rotations(const FrameInput& motion, const TurnPart* part,
                     std::span<const Vec4> deviation, Mat3* s, Index begin, Index end);
/// Handles turn as a whole, and targets as they are asked to.
void turn_held(const SecondInput& input, Rotations& rotations);
/// The rotations that the first system leads to.
void find_rotations(const SecondInput& input, std::span<const Vec4> deviation, TurnPartRoom& room,
                    const Context& context, Rotations& rotations);
/// The same for handles that turn too far for it: by the field of turns, or between both.
void wind_rotations(const SecondInput& input, FrameScratch::State& scratch, const Context& context);
/// Over-relaxation of an ARAP iteration: 0 for none.
double over_relaxation(double max_turn, bool last);
/// Takes those that fit the positions of the second system best, and goes on by `further` times the
/// change.
void refine_rotations(const SecondInput& input, std::span<const Vec4> deviation, double further,
                      RefineRoom& room, const Context& context, Rotations& rotations);

/// The share of the volume that a frame keeps.
double volume_share(const FrameInput& motion);
/// Corrects the deviation in `scratch`, a solution of the second system, by springs across the
/// inside; does nothing for a share of 0.
void keep_volume(const SecondInput& input, FrameScratch::State& scratch, const Context& context);

/// Takes the refined deviation in `scratch` back towards that without refinement, `refine.plain`:
/// more and more as parts that lie apart at rest come near to one another and as edges stretch
/// further than without, and so far that no faces cross if none do without. The result is a
/// function of both deviations, and continuous in them as long as that last guard is not needed.
/// Errors: cancelled; memory_limit.
void limit_refinement(const SecondInput& input, FrameScratch::State& scratch,
                      const Context& context);

/// A frame of a comparison method.
DeformFrame solve_compared(const std::shared_ptr<const Preparation>& preparation,
                           const Poses& poses, FrameScratch::State& scratch,
                           const Context& context);

/// A frame on two levels (levels/level_method.h).
DeformFrame solve_levels(const std::shared_ptr<const Preparation>& preparation, const Poses& poses,
                         FrameScratch::State& scratch, FrameQuality quality,
                         const Context& context);
/// Deformation gradients of the region on two levels: the rotations by which details turn.
std::vector<Mat3> level_gradients(const Preparation& prepared, const Poses& poses,
                                  FrameScratch::State& scratch);

/// Moves parts that follow the surface, whose other vertices `positions` has.
void place_followers(const Preparation& prepared, const Poses& poses, std::vector<Vec3>& positions);
/// Their deformation gradients.
void turn_followers(const Preparation& prepared, const Poses& poses,
                    const std::vector<Vec3>& positions, std::vector<Mat3>& gradients);

/// Returns the frame with `positions` of the free vertices; held ones lie exactly as prescribed.
/// Its poses take the memory of `scratch`.
DeformFrame framed(const std::shared_ptr<const Preparation>& preparation, const FrameInput& motion,
                   FrameScratch::State& scratch, std::vector<Vec3> positions);

}  // namespace lissom
