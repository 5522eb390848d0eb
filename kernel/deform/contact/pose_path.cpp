#include "kernel/deform/contact/pose_path.h"

#include <Eigen/LU>
#include <algorithm>
#include <memory>
#include <utility>

#include "kernel/deform/rotation/polar.h"

namespace lissom {

HandlePath::HandlePath(const RestShape& rest, const Handle& handle, const HandlePose& from,
                       const HandlePose& to)
    : rest_(rest), from_(from), center_(handle.center) {
    const Vec3 local_center = center_ - rest.origin();
    for (const Index v : handle.local) {
        reach_ = std::max(reach_, (rest.patch().rest[lissom::at(v)] - local_center).norm());
    }
    const Affine &a = from.local_transform, &b = to.local_transform;
    rotation_ = nearest_rotation(a.linear);
    const Mat3 end = nearest_rotation(b.linear);
    stretch_from_ = rotation_.transpose() * a.linear;
    stretch_to_ = end.transpose() * b.linear;
    begin_ = a(local_center) - local_center;
    way_ = b(local_center) - a(local_center);
    screw_ = screw_of(turn_near(end * rotation_.transpose(), to.turn - from.turn), way_);
}

HandlePose HandlePath::at(double share) const {
    const Mat3 stretch = (1.0 - share) * stretch_from_ + share * stretch_to_;
    const Mat3 turned_linear = rotation_of_turn(share * screw_.turn) * rotation_ * stretch;
    const Vec3 shift = begin_ + screw_.shift(share) + share * screw_.remainder;
    HandlePose pose = placed(rest_, {turned_linear, shift}, center_);
    pose.turn = turned(from_.turn, share * screw_.turn);
    return pose;
}

double HandlePath::length() const {
    const double stretching = (stretch_to_ - stretch_from_).norm() * reach_;
    const double turning =
        screw_.turn.norm() * reach_ * std::max(stretch_from_.norm(), stretch_to_.norm());
    return way_.norm() + screw_.velocity.norm() + turning + stretching;
}

namespace {

void put_targets_between(const Poses& from, double share, Poses& poses) {
    for (std::size_t t = 0; t < poses.targets.size(); ++t) {
        const TargetPose &a = from.targets[t], &b = poses.targets[t];
        poses.targets[t] = {a.position + share * (b.position - a.position),
                            a.gradient + share * (b.gradient - a.gradient)};
    }
}

}  // namespace

void put_between(const RestShape& rest, const ConstraintSet& constraints, const Poses& from,
                 double share, Poses& poses) {
    if (share == 1.0) return;
    for (std::size_t h = 0; h < poses.handles.size(); ++h) {
        const std::shared_ptr<const Handle>& handle = constraints.handles[h];
        if (!handle || from.handles[h] == poses.handles[h]) continue;
        poses.handles[h] = HandlePath(rest, *handle, from.handles[h], poses.handles[h]).at(share);
    }
    put_targets_between(from, share, poses);
}

PosePath::PosePath(const RestShape& rest, const ConstraintSet& constraints, Poses from, Poses to)
    : from_(std::move(from)), to_(std::move(to)), paths_(to_.handles.size()) {
    from_.handles.resize(to_.handles.size());
    for (std::size_t h = 0; h < paths_.size(); ++h) {
        if (!constraints.handles[h] || from_.handles[h] == to_.handles[h]) continue;
        paths_[h].emplace(rest, *constraints.handles[h], from_.handles[h], to_.handles[h]);
    }
}

Poses PosePath::at(double share) const {
    Poses poses = to_;
    if (share == 1.0) return poses;
    for (std::size_t h = 0; h < paths_.size(); ++h) {
        if (paths_[h]) poses.handles[h] = paths_[h]->at(share);
    }
    put_targets_between(from_, share, poses);
    return poses;
}

double PosePath::length() const {
    double longest = 0.0;
    for (const auto& path : paths_) {
        if (path) longest = std::max(longest, path->length());
    }
    for (std::size_t t = 0; t < to_.targets.size(); ++t) {
        longest = std::max(longest, (to_.targets[t].position - from_.targets[t].position).norm());
    }
    return longest;
}

}  // namespace lissom
