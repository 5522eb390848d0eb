#include "kernel/deform/bones/bone_chain.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "kernel/core/error.h"
#include "kernel/core/rotation.h"

namespace lissom {
namespace {

// Greatest turn of a joint in a round of reaching, radians: the whole chain takes part.
constexpr double kReachStep = 0.15;
// Bend of a chain that points along its target, so that it can begin to fold.
constexpr double kFirstBend = 0.05;
constexpr double kStraight = 1e-6;

void require_joints(const std::vector<Vec3>& joints, const std::vector<double>& limits) {
    require(joints.size() >= 2, "a chain of bones has two joints at least");
    for (const Vec3& joint : joints) {
        require(joint.allFinite(), "a joint is not finite", ErrorCode::not_finite);
    }
    for (std::size_t i = 0; i + 1 < joints.size(); ++i) {
        require((joints[i + 1] - joints[i]).norm() > 0.0,
                "bone " + std::to_string(i + 1) + " has no length: take out one of its joints");
    }
    require(limits.empty() || limits.size() + 1 == joints.size(),
            "there is one limit for each bone, or none at all");
    for (const double limit : limits) {
        require(limit >= 0.0 && limit <= kPi + 1e-9, "limits are angles from 0 to 180 degrees");
    }
}

}  // namespace

BoneChain::BoneChain(std::vector<Vec3> joints, std::vector<double> limits)
    : rest_(std::move(joints)), limits_(std::move(limits)) {
    require_joints(rest_, limits_);
    if (limits_.empty()) limits_.assign(rest_.size() - 1, kPi);
    turns_.assign(rest_.size() - 1, Eigen::Quaterniond::Identity());
    base_ = rest_.front();
}

std::vector<Vec3> BoneChain::joints() const {
    std::vector<Vec3> places = {base_};
    Eigen::Quaterniond frame = Eigen::Quaterniond::Identity();
    for (std::size_t i = 0; i < turns_.size(); ++i) {
        frame = frame * turns_[i];
        places.push_back(places.back() + frame * (rest_[i + 1] - rest_[i]));
    }
    return places;
}

double BoneChain::length() const {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < rest_.size(); ++i) sum += (rest_[i + 1] - rest_[i]).norm();
    return sum;
}

Eigen::Quaterniond BoneChain::rotation(Index bone) const {
    require(bone >= 0 && bone < size(), "there is no such bone", ErrorCode::out_of_range);
    Eigen::Quaterniond frame = Eigen::Quaterniond::Identity();
    for (Index i = 0; i <= bone; ++i) frame = frame * turns_[at(i)];
    return frame.normalized();
}

Affine BoneChain::transform(Index bone) const {
    const Eigen::Quaterniond frame = rotation(bone);
    const Vec3 place = joints()[at(bone)];
    return {frame.toRotationMatrix(), place - frame * rest_[at(bone)]};
}

void BoneChain::set(std::span<const Eigen::Quaterniond> rotations, const Vec3& base) {
    require(rotations.size() == turns_.size(), "there is one rotation for each bone");
    Eigen::Quaterniond before = Eigen::Quaterniond::Identity();
    for (std::size_t i = 0; i < turns_.size(); ++i) {
        turns_[i] = (before.conjugate() * rotations[i]).normalized();
        before = rotations[i];
    }
    base_ = base;
}

void BoneChain::limit(Index bone) {
    Eigen::AngleAxisd turn(turns_[at(bone)].normalized());
    // The angle is from 0 to pi.
    if (turn.angle() <= limits_[at(bone)]) return;
    turn.angle() = limits_[at(bone)];
    turns_[at(bone)] = Eigen::Quaterniond(turn);
}

void BoneChain::turn(Index bone, const Vec3& axis, double angle) {
    require(axis.allFinite() && std::isfinite(angle), "axis and angle are finite numbers",
            ErrorCode::not_finite);
    require(axis.norm() > 0.0, "the axis of a turn has no length");
    const Eigen::Quaterniond before =
        bone > 0 ? rotation(bone - 1) : Eigen::Quaterniond::Identity();
    const Eigen::Quaterniond now =
        Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized())) * rotation(bone);
    turns_[at(bone)] = (before.conjugate() * now).normalized();
    limit(bone);
}

// One joint's part of a round. Returns whether it turned.
bool BoneChain::turn_towards(Index bone, const Vec3& target) {
    const std::vector<Vec3> places = joints();
    const Vec3 tip = places.back() - places[at(bone)], way = target - places[at(bone)];
    if (tip.norm() == 0.0 || way.norm() == 0.0) return false;
    Eigen::AngleAxisd needed(min_rotation(tip, way));
    if (needed.angle() == 0.0) return false;
    turn(bone, needed.axis(), std::min(needed.angle(), kReachStep));
    return true;
}

// A chain that lies along its target would stretch towards it for ever.
void BoneChain::bend_a_little(const Vec3& target, const Vec3& axis) {
    const std::vector<Vec3> places = joints();
    const Vec3 way = target - base_;
    for (const Vec3& place : places) {
        if (way.cross(place - base_).norm() > kStraight * way.norm() * length()) return;
    }
    if (way.norm() >= length() * (1.0 - kStraight) && way.dot(places.back() - base_) > 0.0) return;
    const Vec3 along = (places.back() - base_).normalized();
    const Vec3 given = axis - axis.dot(along) * along;
    const Vec3 about = given.norm() > 1e-9 * axis.norm() ? given : Vec3(along.unitOrthogonal());
    for (Index i = 0; i < size(); ++i) turn(i, about, i == 0 ? -kFirstBend : 2.0 * kFirstBend);
}

double BoneChain::reach(const Vec3& target, const ReachOptions& options) {
    require(target.allFinite() && options.axis.allFinite(), "the target is not finite",
            ErrorCode::not_finite);
    require(options.rounds >= 1 && options.rounds <= 10'000, "there are 1 to 10,000 rounds");
    require(options.tolerance >= 0.0 && std::isfinite(options.tolerance),
            "the tolerance is 0 or more");
    bend_a_little(target, options.axis);
    double off = (joints().back() - target).norm();
    for (int round = 0; round < options.rounds && off > options.tolerance * length(); ++round) {
        bool any = false;
        for (Index bone = size(); bone-- > 0;) any = turn_towards(bone, target) || any;
        off = (joints().back() - target).norm();
        if (!any) break;
    }
    return off;
}

}  // namespace lissom
