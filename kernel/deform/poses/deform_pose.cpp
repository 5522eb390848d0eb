#include "kernel/deform/poses/deform_pose.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "kernel/core/error.h"
#include "kernel/deform/contact/pose_path.h"
#include "kernel/deform/deformer_state.h"
#include "kernel/deform/rotation/winding.h"

namespace lissom {
namespace {

// A stretch with a determinant below this, of a handle of size 1, has gone through zero.
constexpr double kLeastDeterminant = 1e-12;

void require_regular(const Poses& poses) {
    for (const HandlePose& pose : poses.handles) {
        const Mat3& linear = pose.transform.linear;
        require(pose.transform.is_finite(), "the pose is too far away", ErrorCode::not_finite);
        const double scale = linear.norm();
        require(std::abs(linear.determinant()) > kLeastDeterminant * scale * scale * scale,
                "on the way between the poses a handle is scaled by zero, as from a shape to its "
                "mirror image; add a pose between them",
                ErrorCode::singular_transform);
    }
}

double eased(double share, Easing easing) {
    switch (easing) {
        case Easing::smooth:
            return smooth_step(share);
        case Easing::slow_in:
            return share * share;
        case Easing::slow_out:
            return share * (2.0 - share);
        case Easing::step:
            return share < 1.0 ? 0.0 : 1.0;
        default:
            return share;
    }
}

void require_keys(std::span<const PoseKey> keys) {
    require(!keys.empty(), "a path of poses needs a key");
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const bool follows = i == 0 || keys[i].time > keys[i - 1].time;
        require(std::isfinite(keys[i].time) && follows,
                "times of keys must be finite and ascending");
    }
}

}  // namespace

DeformPose pose_of(const Deformer& deformer) {
    const auto& state = DeformerAccess::state(deformer);
    return {state.rest, state.constraints, state.poses};
}

DeformPose blended(const DeformPose& a, const DeformPose& b, double t) {
    DeformPose result;
    blend_into(result, a, b, t);
    return result;
}

void blend_into(DeformPose& result, const DeformPose& a, const DeformPose& b, double t) {
    require(std::isfinite(t), "the share of a blend must be finite", ErrorCode::not_finite);
    const bool same = a.rest && a.rest == b.rest &&
                      a.constraints->targets == b.constraints->targets &&
                      a.poses.handles.size() == b.poses.handles.size();
    require(same,
            "the poses are of other handles; take both from one deformer after its last change of "
            "handles and constraints");
    result = t == 0.0 ? a : b;
    if (t == 0.0) return;
    put_between(*b.rest, *b.constraints, a.poses, t, result.poses);
    if (a.poses.volume && b.poses.volume) {
        const double sum = (1.0 - t) * *a.poses.volume + t * *b.poses.volume;
        result.poses.volume = std::clamp(sum, 0.0, 1.0);
    }
    require_regular(result.poses);
}

void set_pose(Deformer& deformer, const DeformPose& pose) {
    auto& state = DeformerAccess::state(deformer);
    require(pose.rest == state.rest && pose.poses.handles.size() <= state.poses.handles.size(),
            "the pose is of another deformer, or of its rest shape before rebase");
    for (std::size_t h = 0; h < pose.poses.handles.size(); ++h) {
        if (state.constraints->handles[h]) state.poses.handles[h] = pose.poses.handles[h];
    }
    if (pose.constraints->targets != state.constraints->targets) return;
    std::copy(pose.poses.targets.begin(), pose.poses.targets.end(), state.poses.targets.begin());
}

DeformPose pose_at(std::span<const PoseKey> keys, double time, Easing easing) {
    require_keys(keys);
    require(std::isfinite(time), "the time of a pose must be finite", ErrorCode::not_finite);
    const auto after =
        std::find_if(keys.begin(), keys.end(), [&](const PoseKey& key) { return key.time > time; });
    if (after == keys.begin()) return keys.front().pose;
    if (after == keys.end()) return keys.back().pose;
    const PoseKey& before = *(after - 1);
    const double share = (time - before.time) / (after->time - before.time);
    return blended(before.pose, after->pose, eased(share, easing));
}

}  // namespace lissom
