// Poses of handles and targets.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <string>

#include "kernel/core/extended.h"
#include "kernel/deform/holds/mirror.h"
#include "kernel/deform/rest_shape.h"
#include "kernel/deform/rotation/polar.h"
#include "kernel/deform/rotation/winding.h"

namespace lissom {
namespace {

// A transform that moves no point of the region by more than this fraction of its size is the
// identity, so that a drag there and back returns to rest to the bit.
constexpr double kIdentityTolerance = 1e-12;

constexpr double kSingularRatio = 1e-12;

void require_regular(const Affine& transform, const Vec3& about) {
    const double scale = transform.linear.norm();
    if (transform.is_finite() && about.allFinite() &&
        std::abs(transform.linear.determinant()) > kSingularRatio * scale * scale * scale) {
        return;
    }
    throw Error(ErrorCode::singular_transform,
                "the transform flattens space or is not finite; scale by factors other than zero");
}

}  // namespace

HandlePose placed(const RestShape& rest, const Affine& transform, const Vec3& about) {
    using Vec3L = Eigen::Matrix<Extended, 3, 1>;
    using Mat3L = Eigen::Matrix<Extended, 3, 3>;
    const auto moved_to = [&](const Vec3& point) -> Affine {
        const Mat3L turn = transform.linear.cast<Extended>() - Mat3L::Identity();
        const Vec3L arm = point.cast<Extended>() - about.cast<Extended>();
        return {transform.linear,
                (transform.translation.cast<Extended>() + turn * arm).cast<double>()};
    };
    HandlePose pose;
    pose.transform = about.isZero(0.0) ? transform : moved_to(Vec3::Zero());
    pose.local_transform = moved_to(rest.origin());
    return pose;
}

HandlePose reflected(const RestShape& rest, const MirrorPlane& plane, const HandlePose& pose) {
    const Affine whole = reflection(plane);
    HandlePose image;
    image.turn = -(whole.linear * pose.turn);
    if (pose.transform.is_identity()) return image;
    const Affine local = reflection({plane.point - rest.origin(), plane.normal, 0.0});
    image.transform = whole * pose.transform * whole;
    image.local_transform = local * pose.local_transform * local;
    return image;
}

const Handle& handle_of(const ConstraintSet& constraints, HandleId id) {
    if (id.value < 0 || id.value >= count_of(constraints.handles)) {
        throw Error(ErrorCode::handle_removed, "there is no handle with the id " +
                                                   std::to_string(id.value) +
                                                   "; take the number that add_handle returns");
    }
    if (!constraints.handles[id.value]) {
        throw Error(ErrorCode::handle_removed, "the handle was removed; add a new one");
    }
    return *constraints.handles[id.value];
}

void require_poses(const ConstraintSet& constraints, const Poses& poses) {
    const auto require_as_many = [](std::size_t given, std::size_t expected, const char* what) {
        if (given == expected) return;
        throw Error(ErrorCode::invalid_argument,
                    "the poses are of other handles: they have " + std::to_string(given) + " " +
                        what + ", but the preparation has " + std::to_string(expected) +
                        "; take those of Deformer::snapshot after the last change of its handles");
    };
    require_as_many(poses.handles.size(), constraints.handles.size(), "handles");
    require_as_many(poses.targets.size(), constraints.targets.size(), "targets");
}

void pose_handle(const RestShape& rest, const ConstraintSet& constraints, Poses& poses, HandleId id,
                 const Affine& transform, const Vec3& about, const Vec3& turn) {
    const Handle& handle = handle_of(constraints, id);
    require_regular(transform, about);
    if (!turn.allFinite()) {
        throw Error(ErrorCode::not_finite, "the turn of a handle must be finite");
    }
    HandlePose pose = placed(rest, transform, about);
    pose.turn = turn_near(nearest_rotation(transform.linear), turn);
    const Affine& moved = pose.local_transform;
    const double change = (moved.linear - Mat3::Identity()).cwiseAbs().maxCoeff();
    const double shift = moved.translation.cwiseAbs().maxCoeff();
    if (change < kIdentityTolerance && shift <= kIdentityTolerance * rest.size) {
        pose.transform = pose.local_transform = {};
        pose.turn = turn_near(Mat3::Identity(), pose.turn);
    }
    if (handle.partner != kNoIndex) {
        poses.handles[handle.partner] = reflected(rest, handle.mirror, pose);
    }
    poses.handles[id.value] = pose;
}

bool at_rest(const RestShape& rest, const ConstraintSet& constraints, const Poses& poses) {
    for (std::size_t h = 0; h < constraints.handles.size(); ++h) {
        if (constraints.handles[h] && !poses.handles[h].at_rest()) return false;
    }
    for (std::size_t t = 0; t < constraints.targets.size(); ++t) {
        const Target& target = *constraints.targets[t];
        const TargetPose& asked = poses.targets[t];
        const Vec3 at = target.is_hard_vertex()
                            ? rest.positions[rest.region_row[target.row.front().first]]
                            : Vec3(rest.position_of(target.row) + rest.origin());
        if (target.position && asked.position != at) return false;
        if (target.gradient && asked.gradient != Mat3::Identity()) return false;
    }
    return true;
}

}  // namespace lissom
