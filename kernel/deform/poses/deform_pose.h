/// DeformPose: the transforms of a deformer's handles as a value, and blends of two.
///
///     const DeformPose open = pose_of(deformer);
///     ...
///     set_pose(deformer, blended(open, pose_of(deformer), 0.5));
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "kernel/deform/deformer.h"
#include "kernel/deform/holds/poses.h"

namespace lissom {

struct ConstraintSet;
struct RestShape;

/// The goals of all handles and constraints of a deformer. A copy is cheap.
struct DeformPose {
    std::shared_ptr<const RestShape> rest;
    std::shared_ptr<const ConstraintSet> constraints;
    Poses poses;
};

/// Returns the present pose.
DeformPose pose_of(const Deformer& deformer);

/// Returns the pose at `t` on the way from `a`, at 0, to `b`, at 1, both to the bit. Handles turn
/// and shift as screws by the turns that they made, full ones too; stretches and constraints go
/// straight. Beyond 0 and 1 they go on. Errors: invalid_argument for poses of other handles;
/// not_finite; singular_transform if a stretch goes through zero.
DeformPose blended(const DeformPose& a, const DeformPose& b, double t);
/// Puts that into `result`, which is neither of both and whose memory is used again. After an error
/// `result` is undefined.
void blend_into(DeformPose& result, const DeformPose& a, const DeformPose& b, double t);

/// Moves the handles and constraints of a deformer to a pose, for the next solve. Those that were
/// added since stay, and those that were removed are passed over. Errors: invalid_argument for a
/// pose of another deformer or of an earlier rest shape.
void set_pose(Deformer& deformer, const DeformPose& pose);

/// The pace between two keys of a path of poses.
enum class Easing {
    linear,    ///< even
    smooth,    ///< slow at both keys
    slow_in,   ///< slow at the first key
    slow_out,  ///< slow at the second key
    step,      ///< the first pose until the second key
};

/// A pose at a time in seconds.
struct PoseKey {
    double time = 0.0;
    DeformPose pose;
};

/// Returns the pose at `time` on a path of keys; before the first and after the last key it is
/// theirs. Errors: invalid_argument without keys, and for times that are not finite and ascending;
/// as blended.
DeformPose pose_at(std::span<const PoseKey> keys, double time, Easing easing = Easing::linear);

}  // namespace lissom
