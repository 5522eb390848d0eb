// Inverse kinematics of BoneChain.
#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include "kernel/core/error.h"
#include "kernel/core/rotation.h"
#include "kernel/deform/bones/bone_chain.h"

namespace lissom {
namespace {

constexpr double kFarthestTarget = 1e100;
// Greatest turn of a joint in a round of reaching, radians: the whole chain takes part.
constexpr double kReachStep = 0.15;
// Bend of a chain that points along its target, so that it can begin to fold.
constexpr double kFirstBend = 0.05;
constexpr double kStraight = 1e-6;
// Damping of a common turn, as a part of the mean stiffness, at first and at least; and its tries.
constexpr double kFirstDamping = 1e-3;
constexpr double kLeastDamping = 1e-12;
constexpr int kDampingTries = 8;
// A round that brings the tip nearer by less of the chain's length is the last.
constexpr double kLeastGain = 1e-13;

void require_reach(const Vec3& target, const ReachOptions& options) {
    require(target.allFinite() && target.cwiseAbs().maxCoeff() <= kFarthestTarget &&
                options.axis.allFinite(),
            "the target or the axis is not finite, or beyond 1e100", ErrorCode::not_finite);
    require(options.rounds >= 1 && options.rounds <= 10'000, "there are 1 to 10,000 rounds");
    require(options.tolerance >= 0.0 && std::isfinite(options.tolerance),
            "the tolerance is 0 or more");
}

}  // namespace

// The targets that a chain without limits cannot reach lie beyond its length, or within the rest
// that its longest bone leaves of the others: then all bones lie along one line. Returns whether
// that is so.
bool BoneChain::lie_straight(const Vec3& target) {
    const std::vector<Vec3> places = joints();
    std::vector<double> lengths;
    for (std::size_t i = 0; i + 1 < rest_.size(); ++i) {
        lengths.push_back((rest_[i + 1] - rest_[i]).norm());
    }
    const auto longest = static_cast<std::size_t>(std::max_element(lengths.begin(), lengths.end()) -
                                                  lengths.begin());
    const Vec3 way = target - base_;
    const bool is_far = way.norm() >= length();
    if (!is_far && 2.0 * lengths[longest] - length() < way.norm()) return false;
    const Vec3 tip = places.back() - base_;
    const Vec3 along = way.norm() > 0.0 ? way : (tip.norm() > 0.0 ? tip : Vec3(Vec3::UnitX()));
    std::vector<Eigen::Quaterniond> turned = frames();
    for (std::size_t i = 0; i < turned.size(); ++i) {
        const Vec3 wanted = is_far || i == longest ? along : Vec3(-along);
        turned[i] = min_rotation(places[i + 1] - places[i], wanted) * turned[i];
    }
    set(turned, base_);
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

// From the last joint to the first each turns so that the tip comes nearest to the target. The
// joints before it stay, so that a round is linear in their number.
void BoneChain::turn_each(const Vec3& target) {
    const std::vector<Vec3> places = joints();
    const std::vector<Eigen::Quaterniond> turned = frames();
    Vec3 tip = places.back();
    for (Index bone = size(); bone-- > 0;) {
        const Vec3 arm = tip - places[at(bone)], way = target - places[at(bone)];
        if (arm.norm() == 0.0 || way.norm() == 0.0) continue;
        Eigen::AngleAxisd needed(min_rotation(arm, way));
        needed.angle() = std::min(needed.angle(), kReachStep);
        const auto before = bone > 0 ? turned[at(bone - 1)] : Eigen::Quaterniond::Identity();
        const Eigen::Quaterniond kept = turns_[at(bone)];
        turns_[at(bone)] = (before.conjugate() * needed * turned[at(bone)]).normalized();
        limit(bone);
        const Eigen::Quaterniond moved = before * turns_[at(bone)] * turned[at(bone)].conjugate();
        const Vec3 next = places[at(bone)] + moved * arm;
        if ((next - target).squaredNorm() <= (tip - target).squaredNorm()) {
            tip = next;
        } else {
            turns_[at(bone)] = kept;
        }
    }
}

// All joints turn at once, by the least squares of their turns that bring the tip to the target,
// damped until it comes nearer. Joints at their limit stay.
void BoneChain::turn_together(const Vec3& target, double& damping) {
    const std::vector<Vec3> places = joints();
    const std::vector<Eigen::Quaterniond> turned = frames(), kept = turns_;
    const Vec3 tip = places.back(), off = target - tip;
    std::vector<char> stays(kept.size(), 0);
    for (int tries = 0; tries < kDampingTries; ++tries) {
        Mat3 stiffness = Mat3::Zero();
        for (std::size_t i = 0; i < kept.size(); ++i) {
            const Vec3 arm = tip - places[i];
            if (!stays[i])
                stiffness += arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose();
        }
        if (stiffness.trace() == 0.0) break;
        stiffness.diagonal().array() += damping * stiffness.trace();
        const Vec3 force = stiffness.ldlt().solve(off);
        bool any_stays = false;
        for (Index i = 0; i < size(); ++i) {
            const Vec3 turn = (tip - places[at(i)]).cross(force);
            if (stays[at(i)] || turn.norm() == 0.0) continue;
            const auto before = i > 0 ? turned[at(i - 1)] : Eigen::Quaterniond::Identity();
            const Eigen::AngleAxisd step(turn.norm(), turn.normalized());
            turns_[at(i)] = (before.conjugate() * step * turned[at(i)]).normalized();
            if (limit(i)) stays[at(i)] = any_stays = true;
        }
        if (distance_to(target) < off.norm()) {
            damping = std::max(0.1 * damping, kLeastDamping);
            return;
        }
        turns_ = kept;
        if (!any_stays) damping *= 10.0;
    }
}

double BoneChain::reach(const Vec3& target, const ReachOptions& options) {
    require_reach(target, options);
    if (is_free() && lie_straight(target)) return distance_to(target);
    const std::vector<Eigen::Quaterniond> start = turns_;
    const double far = distance_to(target);
    bend_a_little(target, options.axis);
    double off = distance_to(target), damping = kFirstDamping;
    for (int round = 0; round < options.rounds && off > options.tolerance * length(); ++round) {
        const double before = off;
        turn_each(target);
        turn_together(target, damping);
        off = distance_to(target);
        if (before - off <= kLeastGain * length()) break;
    }
    if (off <= far) return off;
    turns_ = start;
    return far;
}

}  // namespace lissom
